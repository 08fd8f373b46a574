// SPDX-License-Identifier: MIT
/// @file
/// Does a transport keep the laws of its concept that can be seen from outside? A suite for any test framework, or none.
///
///     tsubu::run_ranks(4, [](tsubu::local_transport& on) {
///         tsubu::testing::check_transport(on, 7, 100, [](bool ok, std::string_view law) { ... });
///     });
///
/// Called by every rank, with the same seed and steps: what each of them sends follows from these, so that each knows
/// what is to come. Every law that is checked is reported, kept or not, on the rank that sees it; a broken one with the
/// rank, the step and the seed behind its text, which begins with "law" and the number that it has in
/// comm/transport.hpp. check is called by each rank in its own thread or process. No rank leaves early: a transport
/// that breaks a law does not make the others wait.
#pragma once

#include <tsubu/comm/mailbox.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/types.hpp>

#include <algorithm>    // std::equal, std::max, std::min
#include <bit>          // std::bit_cast
#include <cmath>        // std::abs
#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint64_t
#include <deque>        // std::deque
#include <limits>       // std::numeric_limits
#include <span>         // std::span
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <type_traits>  // std::remove_reference_t
#include <utility>      // std::move, std::swap
#include <vector>       // std::vector

namespace tsubu::testing {

/// The laws of transport as the suite reports them: a name for each text; never an object.
struct transport_law {
    transport_law() = delete;

    static constexpr const char* arrived = "law 1: each parcel arrives once, whole, at its rank";
    static constexpr const char* in_order = "law 1: parcels come by rank of the sender, of one sender in their order";
    static constexpr const char* summed = "law 1: each of the sums becomes that over all ranks, modulo 2^64";
    static constexpr const char* reduced = "law 2: a number becomes the sum, the least or the greatest over all ranks";
    static constexpr const char* same = "law 2: a sum that rounds is the same on all ranks, bit for bit";
    static constexpr const char* gathered = "law 3: gather has one parcel from each rank, in their order";
    static constexpr const char* before = "law 4: sum_before is the sum over the ranks below";
    static constexpr const char* brought = "law 5: a channel brings what out held when it was started";
    static constexpr const char* left_alone = "law 5: what goes out is left alone";
    static constexpr const char* tags = "law 5: next_tag is the same on all ranks, each time another";
};

}  // namespace tsubu::testing

namespace tsubu::detail {

template <class Transport, class Check>
class transport_examiner {
    using law = testing::transport_law;
    using words_type = std::vector<std::uint64_t>;

public:
    transport_examiner(Transport& on, std::uint64_t seed, Check& check) : on_(on), seed_(seed), check_(check) {}

    void step(std::size_t number) {
        number_ = number;
        random_stream plan(splitmix64(seed_) + number);  // the same on all ranks
        exchange(plan);
        reduce(plan);
        gather(plan);
        sum_before(plan);
    }
    /// Several channels at once, some with one tag: the first starts of all ranks are in one order, and so are the
    /// others; how they are finished is up to each rank.
    void channels(std::size_t rounds) {
        constexpr std::size_t count = 4;
        std::vector<int> tags;
        if (!agreed_tags(count - 1, tags)) return;  // on all ranks, or none: messages would never meet
        tags.push_back(tags.back());
        random_stream plan(splitmix64(seed_) ^ 5U);
        std::deque<way> ways;
        for (std::size_t k = 0; k < count; ++k) {
            std::vector<lane> out;
            std::vector<lane> in;
            for (std::size_t from = 0; from < on_.ranks(); ++from)
                for (std::size_t to = 0; to < on_.ranks(); ++to) {
                    const auto words = length(plan);
                    if (from == to || plan.below(4) == 0) continue;
                    if (from == on_.rank()) out.push_back({static_cast<rank_t>(to), words});
                    if (to == on_.rank()) in.push_back({static_cast<rank_t>(from), words});
                }
            ways.push_back({typename Transport::channel(on_, tags[k], out, in), k, std::move(out), std::move(in), {}});
        }
        for (number_ = 0; number_ < rounds; ++number_) {
            auto starts = shuffled(count, plan);
            starts.resize(1 + plan.below(count));
            for (const auto k : starts) start(ways[k]);
            if (plan.below(3) == 0) exchange(plan);
            for (const auto k : starts) see_out(ways[k]);
            random_stream own(splitmix64(seed_ + number_) + on_.rank());
            for (const auto k : shuffled(starts.size(), own)) finish(ways[starts[k]]);
        }
    }

private:
    /// A channel, and what this rank knows of it.
    struct way {
        typename Transport::channel channel;
        std::size_t name;
        std::vector<lane> out;
        std::vector<lane> in;
        words_type sent;
    };
    struct letter {
        std::size_t from;
        std::size_t to;
        words_type words;
    };

    // None, few, and so many that messages may be cut.
    [[nodiscard]] static std::size_t length(random_stream& plan) {
        switch (plan.below(8)) {
            case 0:
            case 1: return 0;
            case 2: return plan.below(300);
            default: return plan.below(9);
        }
    }
    [[nodiscard]] static words_type some_words(std::size_t count, std::uint64_t from) {
        random_stream random(from);
        words_type words(count);
        for (auto& word : words) word = random();
        return words;
    }
    [[nodiscard]] static std::vector<std::size_t> shuffled(std::size_t count, random_stream& random) {
        std::vector<std::size_t> order(count);
        for (std::size_t k = 0; k < count; ++k) {
            order[k] = k;
            std::swap(order[k], order[random.below(k + 1)]);
        }
        return order;
    }
    [[nodiscard]] static bool are_equal(std::span<const std::uint64_t> a, std::span<const std::uint64_t> b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end());
    }

    void exchange(random_stream& plan) {
        // Nothing at all, one sender, a few parcels of each, or many.
        const auto ranks = on_.ranks();
        const auto kind = plan.below(4);
        const auto only = plan.below(ranks);
        std::vector<letter> letters;
        for (std::size_t from = 0; from < ranks; ++from) {
            const auto count = kind == 0 || (kind == 1 && from != only) ? 0 : plan.below(kind == 3 ? 3 * ranks : 4);
            const auto favourite = plan.below(ranks);  // of whom several parcels are for one rank
            for (std::size_t k = 0; k < count; ++k) {
                const auto to = plan.below(3) == 0 ? favourite : plan.below(ranks);
                const auto words = length(plan);
                letters.push_back({from, to, some_words(words, plan())});
            }
        }
        std::vector<parcel> parcels;
        std::vector<const letter*> wanted;
        for (const auto& one : letters) {
            if (one.from == on_.rank()) parcels.push_back({static_cast<rank_t>(one.to), one.words});
            if (one.to == on_.rank()) wanted.push_back(&one);
        }
        words_type sums(plan.below(4));
        words_type all(sums.size());
        for (std::size_t from = 0; from < ranks; ++from)
            for (std::size_t k = 0; k < sums.size(); ++k) {
                const auto part = plan();
                all[k] += part;
                if (from == on_.rank()) sums[k] = part;
            }
        const auto came = on_.exchange(parcels, sums);
        expect(sums == all, law::summed, [&] { return shown(sums.size()) + " sums"; });
        expect_letters(came, wanted);
    }
    void expect_letters(const mailbox& came, const std::vector<const letter*>& wanted) {
        const auto is = [](const parcel& one, const letter& other) {
            return one.rank == other.from && are_equal(one.words, other.words);
        };
        // Each of those that are wanted is found once: first all that are there, then their order.
        std::vector<bool> is_found(came.size(), false);
        bool are_all_there = came.size() == wanted.size();
        for (const auto* one : wanted) {
            std::size_t at = 0;
            while (at < came.size() && (is_found[at] || !is(came[at], *one))) ++at;
            if (at < came.size())
                is_found[at] = true;
            else
                are_all_there = false;
        }
        const auto what = [&] { return shown(came.size()) + " parcels came, " + shown(wanted.size()) + " were sent"; };
        expect(are_all_there, law::arrived, what);
        if (!are_all_there) return;
        bool are_in_order = true;
        for (std::size_t k = 0; k < wanted.size(); ++k) are_in_order = are_in_order && is(came[k], *wanted[k]);
        expect(are_in_order, law::in_order, what);
    }

    void reduce(random_stream& plan) {
        const auto how = static_cast<reduction>(plan.below(3));
        const auto count = plan.below(5);
        words_type words;
        words_type all_words(count);
        std::vector<double> numbers;
        std::vector<double> all_numbers(count);
        std::vector<double> rounded;
        std::vector<double> all_rounded(count);
        std::vector<double> size(count);
        constexpr auto infinity = std::numeric_limits<double>::infinity();
        for (std::size_t from = 0; from < on_.ranks(); ++from)
            for (std::size_t k = 0; k < count; ++k) {
                const auto word = plan() >> plan.below(64);
                // Whole numbers have sums without rounding, in any order.
                auto number = static_cast<double>(plan.below(1U << 20)) - (1U << 19);
                if (plan.below(4) == 0 && how != reduction::sum) number = plan.below(2) == 0 ? infinity : -infinity;
                const auto rounds = (plan.unit() - 0.5) * static_cast<double>(1 + plan.below(1000));
                all_words[k] = from == 0 ? word : joined(how, all_words[k], word);
                all_numbers[k] = from == 0 ? number : joined(how, all_numbers[k], number);
                all_rounded[k] += rounds;
                size[k] += std::abs(rounds);
                if (from != on_.rank()) continue;
                words.push_back(word);
                numbers.push_back(number);
                rounded.push_back(rounds);
            }
        const auto what = [&] { return shown(count) + " numbers, kind " + shown(static_cast<int>(how)); };
        on_.reduce(std::span<std::uint64_t>(words), how);
        expect(words == all_words, law::reduced, what);
        on_.reduce(std::span<double>(numbers), how);
        expect(numbers == all_numbers, law::reduced, what);
        on_.reduce(std::span<double>(rounded), reduction::sum);
        bool is_near = true;
        words_type bits;
        for (std::size_t k = 0; k < count; ++k) {
            const auto slack = size[k] * static_cast<double>(on_.ranks()) * std::numeric_limits<double>::epsilon();
            is_near = is_near && std::abs(rounded[k] - all_rounded[k]) <= slack;
            bits.push_back(std::bit_cast<std::uint64_t>(rounded[k]));
        }
        expect(is_near, law::reduced, what);
        const auto of_all = on_.gather(bits);
        bool are_same = true;
        for (const auto& [from, theirs] : of_all) are_same = are_same && are_equal(theirs, bits);
        expect(are_same, law::same, what);
    }
    template <class Number>
    [[nodiscard]] static Number joined(reduction how, Number a, Number b) {
        return how == reduction::sum ? a + b : how == reduction::least ? (std::min)(a, b) : (std::max)(a, b);
    }

    void gather(random_stream& plan) {
        std::vector<words_type> all;
        for (std::size_t from = 0; from < on_.ranks(); ++from) {
            const auto words = length(plan);
            all.push_back(some_words(words, plan()));
        }
        const auto came = on_.gather(all[on_.rank()]);
        bool is_kept = came.size() == on_.ranks();
        for (std::size_t from = 0; is_kept && from < on_.ranks(); ++from)
            is_kept = came[from].rank == from && are_equal(came[from].words, all[from]);
        expect(is_kept, law::gathered, [&] { return shown(came.size()) + " parcels, of which one differs"; });
    }
    void sum_before(random_stream& plan) {
        std::uint64_t below = 0;
        std::uint64_t mine = 0;
        for (std::size_t from = 0; from < on_.ranks(); ++from) {
            const auto number = plan() >> plan.below(64);
            if (from < on_.rank()) below += number;
            if (from == on_.rank()) mine = number;
        }
        const auto found = on_.sum_before(mine);
        expect(found == below, law::before, [&] { return shown(found) + " instead of " + shown(below); });
    }

    [[nodiscard]] bool agreed_tags(std::size_t count, std::vector<int>& tags) {
        words_type mine;
        for (std::size_t k = 0; k < count; ++k) {
            tags.push_back(on_.next_tag());
            mine.push_back(static_cast<std::uint64_t>(tags.back()));
        }
        const auto of_all = on_.gather(mine);
        bool are_same = true;
        for (const auto& [from, theirs] : of_all) are_same = are_same && are_equal(theirs, mine);
        bool is_used_twice = false;
        for (std::size_t k = 1; k < count; ++k) is_used_twice = is_used_twice || tags[k] == tags[k - 1];
        // One rank has no other, and needs no tag.
        expect(are_same && (on_.ranks() == 1 || !is_used_twice), law::tags, [] { return std::string("3 tags"); });
        // What one rank finds others may not: all of them go on, or none.
        const std::uint64_t verdict[] = {are_same ? 0U : 1U};
        std::uint64_t broken = 0;
        const auto verdicts = on_.gather(verdict);
        for (const auto& [from, theirs] : verdicts) broken += theirs.empty() ? 1 : theirs[0];
        return broken == 0;
    }
    // What goes from one rank to another in a round.
    [[nodiscard]] words_type lane_words(const way& of, std::size_t from, std::size_t to, std::size_t words) const {
        const auto name = ((number_ * 64 + of.name) * 4096 + from) * 4096 + to;
        return some_words(words, splitmix64(seed_) + splitmix64(name));
    }
    void start(way& of) {
        of.sent.clear();
        for (const auto& [to, words] : of.out) {
            const auto some = lane_words(of, on_.rank(), to, words);
            of.sent.insert(of.sent.end(), some.begin(), some.end());
        }
        // A transport of one rank has no room for anything.
        for (std::size_t k = 0; k < of.sent.size(); ++k) of.channel.out()[k] = of.sent[k];
        of.channel.start();
    }
    void see_out(way& of) {
        const auto out = of.channel.out();
        expect(are_equal(out, of.sent), law::left_alone, [&] { return "channel " + shown(of.name); });
    }
    void finish(way& of) {
        of.channel.finish();
        see_out(of);
        words_type wanted;
        for (const auto& [from, words] : of.in) {
            const auto some = lane_words(of, from, on_.rank(), words);
            wanted.insert(wanted.end(), some.begin(), some.end());
        }
        expect(are_equal(of.channel.in(), wanted), law::brought, [&] { return "channel " + shown(of.name); });
    }

    template <class What>
    void expect(bool kept, const char* text, What&& what) {
        if (kept) return check_(true, std::string_view(text));
        check_(false, std::string_view(std::string(text) + "; " + what() + "; rank " + shown(on_.rank()) + " of " +
                                       shown(on_.ranks()) + ", step " + shown(number_) + ", seed " + shown(seed_)));
    }

    Transport& on_;
    std::uint64_t seed_;
    Check& check_;
    std::size_t number_ = 0;
};

}  // namespace tsubu::detail

namespace tsubu::testing {

/// Does this transport keep laws 1 to 5? What becomes of an exchange on a rank without memory is not examined; law 6 is
/// a matter of speed. Pass a transport that cuts long messages with a length of a few words too.
///
/// @param seed   same seed, same run, on every machine
/// @param steps  of each: an exchange, three reductions, a gather, a sum_before; then a round of four channels
/// @param check  called as check(bool kept, std::string_view law), many times per step
/// Collective: yes; the same seed and steps on all ranks.
template <transport Transport, class Check>
void check_transport(Transport& on, std::uint64_t seed, std::size_t steps, Check&& check) {
    detail::transport_examiner<Transport, std::remove_reference_t<Check>> examiner(on, seed, check);
    for (std::size_t k = 0; k < steps; ++k) examiner.step(k);
    examiner.channels(steps);
}

}  // namespace tsubu::testing

// SPDX-License-Identifier: MIT
/// @file
/// One run of the conformance suite of id_storage: what is asked, written, copied, and refused memory.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/core/threads.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/id/concepts.hpp>
#include <tsubu/id/id_range.hpp>
#include <tsubu/testing/detail/poisoned_links.hpp>
#include <tsubu/testing/id_model.hpp>
#include <tsubu/testing/id_patterns.hpp>
#include <tsubu/testing/id_storage_laws.hpp>
#include <tsubu/testing/throwing_allocator.hpp>

#include <algorithm>    // std::equal, std::min
#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint64_t
#include <limits>       // std::numeric_limits
#include <new>          // std::bad_alloc
#include <span>         // std::span
#include <string>       // std::string, std::to_string
#include <string_view>  // std::string_view
#include <utility>      // std::move, std::swap
#include <vector>       // std::vector

namespace tsubu::detail {

/// One run of the suite: a storage and a model that receive the same writes.
template <class Storage, class Check>
class id_storage_examiner {
    using id_type = typename Storage::id_type;
    using bits = unsigned_id<id_type>;
    using model_type = testing::id_model<id_type>;
    static constexpr auto highest = (std::numeric_limits<id_type>::max)();

public:
    id_storage_examiner(std::uint64_t seed, Check& check, const Storage& prototype)
        : seed_(seed), random_(seed), check_(check), prototype_(prototype), subject_(prototype) {}

    /// Sizes around the capacities of LIGGGHTS' scheme, 1000 and then twice the last count that did not fit.
    void walk_sizes() {
        compare(testing::law::total);
        for (const std::size_t count : {0U, 1U, 2U, 1000U, 1001U, 2002U, 2003U, 4006U, 4007U, 1001U, 3U, 0U, 1U}) {
            for (const auto pattern : {testing::id_pattern::lattice, testing::id_pattern::sparse}) {
                pattern_ = pattern;
                auto ids = testing::make_ids<id_type>(pattern, count, random_);
                if (pattern == testing::id_pattern::lattice)
                    for (std::size_t k = 0; k < count; ++k) ids[k] = static_cast<id_type>(k);
                const bool taken = rebuild(ids);
                if (pattern == testing::id_pattern::lattice) expect(taken, testing::law::accepts);
            }
            write_some(20);
        }
        grow_by_assign();
        grow_by_assign();  // in the memory that clear has left
    }
    void step() {
        ++step_;
        pattern_ = static_cast<testing::id_pattern>(random_.below(testing::id_pattern_count));
        rebuild(random_.below(4) == 0 ? altered_ids() : testing::make_ids<id_type>(pattern_, next_size(), random_));
        if (random_.below(4) == 0) write_some(12);
        if (random_.below(32) == 0) clear();
        if (random_.below(32) == 0) reserve(random_.below(5000));
        if (random_.below(16) == 0) copy_and_move();
    }
    /// Large enough that a table outgrows a cache and a team of threads shares the work.
    void examine_large(std::size_t count) {
        using testing::id_pattern;
        for (const auto pattern : {id_pattern::sparse, id_pattern::full_width, id_pattern::rank_low}) {
            pattern_ = pattern;
            rebuild(testing::make_ids<id_type>(pattern, count, random_), true);
        }
    }
    void examine_failures(testing::allocation_gate& gate) {
        ++step_;
        fail_rebuild(gate);
        fail_reserve(gate);
        fail_assign(gate);
        assign_without_memory(gate);
    }
    void examine_bytes(const testing::allocation_gate& gate) {
        const auto before = gate.bytes();
        Storage copy(prototype_);
        const auto agree = [&] {
            const auto held = gate.bytes() - before;
            const auto said = copy.memory_bytes();
            // Within a sixteenth and a page: what a container keeps beside its table is no one's concern.
            const auto slack = held / 16 + 4096;
            return said <= held + slack && held <= said + slack;
        };
        expect(agree(), testing::law::bytes);
        for (const std::size_t count : {100U, 4000U, 100U}) {
            const auto ids = testing::make_ids<id_type>(testing::id_pattern::lattice, count, random_);
            copy.rebuild(ids, range_of(std::span<const id_type>(ids)), {});
            expect(agree(), testing::law::bytes);
        }
        copy.clear();
        expect(agree(), testing::law::bytes);
    }

private:
    void expect(bool ok, const char* law) {
        if (ok) return check_(true, std::string_view(law));
        std::string text = law;
        text += " [ids: " + std::string(testing::name_of(pattern_)) + ", " + std::to_string(model_.size()) +
                " different, step " + std::to_string(step_) + ", seed " + std::to_string(seed_);
        if (blamed_ != no_blame) text += ", id " + std::to_string(static_cast<id_type>(blamed_));
        text += "]";
        check_(false, std::string_view(text));
    }

    // --- reading ----------------------------------------------------------------------------------------------

    /// All ids, those of the last rebuild, and their neighbours in every sense in which a table may confuse them.
    [[nodiscard]] std::vector<id_type> questions(const model_type& model) {
        std::vector<id_type> asked;
        asked.reserve(model.size() + former_.size() + 96);
        for (const auto& entry : model.entries()) asked.push_back(entry.id);
        for (const auto t : former_) asked.push_back(t);
        const auto known = asked.size();
        for (std::size_t k = 0; k < 8; ++k) {
            const auto base = known == 0 ? bits{0} : static_cast<bits>(asked[random_.below(known)]);
            constexpr int width = std::numeric_limits<bits>::digits;
            const auto flipped = static_cast<bits>(base ^ static_cast<bits>(bits{1} << random_.below(width)));
            const auto half = static_cast<bits>(base + static_cast<bits>(bits{1} << (width / 2)));
            for (const bits value : {static_cast<bits>(base + 1), static_cast<bits>(base - 1), flipped, half,
                                     static_cast<bits>(~base), static_cast<bits>(random_())})
                asked.push_back(static_cast<id_type>(value));
        }
        constexpr auto lowest = (std::numeric_limits<id_type>::min)();
        for (const id_type value : {id_type{0}, id_type{1}, static_cast<id_type>(~bits{0}), highest,
                                    static_cast<id_type>(highest - 1), lowest, static_cast<id_type>(lowest + 1),
                                    static_cast<id_type>(bits{1} << 31), static_cast<id_type>((bits{1} << 31) - 1)})
            asked.push_back(value);
        return asked;
    }

    /// Answers, size, and abilities of `storage` against `model`.
    void compare(const Storage& storage, const model_type& model, const char* known_law) {
        const auto asked = questions(model);
        std::vector<index_t> expected(asked.size());
        bool known_right = true;
        bool others_absent = true;
        bool still_right = true;
        const auto known = model.size() + former_.size();
        for (std::size_t k = 0; k < asked.size(); ++k) {
            expected[k] = model.find(asked[k]);
            if (storage.find(asked[k]) == expected[k]) continue;
            if (k < known || expected[k] != absent)
                blame(asked[k], known_right);
            else
                blame(asked[k], others_absent);
        }
        expect(known_right, known_law);
        expect(others_absent, testing::law::total);
        if constexpr (batched_lookup<Storage>) {
            constexpr index_t poison = -77;
            // Any start: the questions and answers of a batch are aligned to their own types only.
            const auto first = asked.empty() ? 0 : random_.below((std::min)(asked.size(), std::size_t{9}));
            const auto count = asked.size() - first - random_.below((std::min)(asked.size() - first, std::size_t{9}));
            std::vector<index_t> answers(asked.size() + 1, poison);
            storage.find(std::span(asked).subspan(first, count), std::span(answers).subspan(first, count));
            bool same = true;
            for (std::size_t k = 0; k < answers.size(); ++k) {
                const bool inside = k >= first && k < first + count;
                if (answers[k] != (inside ? storage.find(asked[k]) : poison)) same = false;
            }
            expect(same, testing::law::batch);
        }
        if constexpr (prefetchable<Storage>) {
            if (random_.below(8) == 0) {
                for (const auto t : asked) storage.prefetch(t);
                for (std::size_t k = 0; k < asked.size(); ++k)
                    if (known_right && others_absent && storage.find(asked[k]) != expected[k]) still_right = false;
                expect(still_right, testing::law::prefetched);
            }
        }
        blamed_ = no_blame;
        expect(storage.size() == model.size(), testing::law::size);
        expect(storage.size() == 0 || storage.memory_bytes() != 0, testing::law::bytes);
    }
    void compare(const char* known_law) { compare(subject_, model_, known_law); }
    void blame(id_type t, bool& right) noexcept {
        if (right && blamed_ == no_blame) blamed_ = static_cast<bits>(t);
        right = false;
    }

    // --- writing ----------------------------------------------------------------------------------------------

    [[nodiscard]] std::size_t next_size() {
        switch (random_.below(64)) {
            case 0: return 0;
            case 1: return 1;
            case 2: return 1000;
            case 3: return 1001;
            case 4: return random_.below(4100);
            default: return random_.below(64);
        }
    }
    /// The ids of the last rebuild, as a step of a simulation changes them.
    [[nodiscard]] std::vector<id_type> altered_ids() {
        auto ids = former_;
        if (random_.below(4) == 0) ids.resize(random_.below(ids.size() + 1));
        for (auto fresh = random_.below(8); fresh > 0; --fresh)
            ids.push_back(!ids.empty() && random_.below(2) == 0 ? ids[random_.below(ids.size())] : some_id());
        for (auto swaps = random_.below(8); swaps > 0 && !ids.empty(); --swaps)
            std::swap(ids[random_.below(ids.size())], ids[random_.below(ids.size())]);
        return ids;
    }
    [[nodiscard]] id_type some_id() {
        const auto entries = model_.entries();
        switch (random_.below(4)) {
            case 0: return static_cast<id_type>(random_.below(64));
            case 1: return static_cast<id_type>(static_cast<bits>(random_()) & static_cast<bits>(highest));
            default: {
                if (entries.empty()) return static_cast<id_type>(random_.below(5000));
                const auto t = entries[random_.below(entries.size())].id;
                return random_.below(4) == 0 && t < highest ? static_cast<id_type>(t + 1) : t;
            }
        }
    }
    [[nodiscard]] index_t some_index() {
        const auto bound = random_.below(4) == 0 ? max_index_count : former_.size() + 4;
        return static_cast<index_t>(random_.below(bound));
    }

    /// @return whether the storage took the ids
    bool rebuild(const std::vector<id_type>& ids, bool always_in_parallel = false) {
        const std::span<const id_type> span(ids);
        const bool with_links = random_.below(4) != 0;
        poisoned_links links(ids.size(), random_);
        try {
            subject_.rebuild(span, range_of(span), with_links ? links.span() : std::span<index_t>());
        } catch (const limit_error&) {
            compare(testing::law::strong);
            expect(links.untouched(), testing::law::strong_links);
            return false;
        }
        const auto expected = model_.rebuild(span);
        check_links(links, with_links, expected, testing::law::links);
        // The ids of before are asked for as well: they are what a table that was not emptied still knows.
        compare(testing::law::lookup);
        former_ = ids;
        if constexpr (parallel_rebuild<Storage>)
            if (always_in_parallel || random_.below(64) == 0) rebuild_in_parallel(span, expected);
        return true;
    }
    void check_links(poisoned_links& links, bool with_links, const std::vector<index_t>& expected, const char* law) {
        expect(links.untouched_outside(), testing::law::outside);
        if (!with_links) return expect(links.untouched(), testing::law::outside);
        const auto written = links.span();
        expect(std::equal(written.begin(), written.end(), expected.begin(), expected.end()), law);
    }
    void rebuild_in_parallel(std::span<const id_type> ids, const std::vector<index_t>& expected) {
        for (const std::size_t count : {1U, 2U, 3U}) {
            Storage other(random_.below(2) == 0 ? prototype_ : subject_);
            poisoned_links links(ids.size(), random_);
            other.rebuild(ids, range_of(ids), links.span(), threads(count));
            check_links(links, true, expected, testing::law::parallel);
            compare(other, model_, testing::law::parallel);
        }
    }
    void assign(id_type t, index_t index, bool with_all) {
        try {
            subject_.assign(t, index);
        } catch (const limit_error&) {
            return compare(testing::law::strong);
        }
        model_.assign(t, index);
        blamed_ = static_cast<bits>(t);
        expect(subject_.find(t) == index, testing::law::assigned);
        blamed_ = no_blame;
        if (with_all) compare(testing::law::assigned_others);
    }
    void erase(id_type t, bool with_all) {
        blamed_ = static_cast<bits>(t);
        const bool was_there = model_.erase(t);
        expect(subject_.erase(t) == was_there, testing::law::erased);
        expect(subject_.find(t) == absent, testing::law::erased);
        blamed_ = no_blame;
        if (with_all) compare(testing::law::erased_others);
    }
    void write_some(std::size_t count) {
        const bool with_all = model_.size() <= 64;
        for (std::size_t k = 0; k < count; ++k) {
            if (random_.below(2) == 0)
                assign(some_id(), some_index(), with_all);
            else
                erase(random_.below(16) == 0 ? static_cast<id_type>(random_()) : some_id(), with_all);
        }
        if (!with_all) compare(testing::law::assigned_others);
        if (random_.below(8) == 0) {  // down to nothing, one by one
            while (model_.size() != 0) erase(model_.entries()[random_.below(model_.size())].id, model_.size() < 8);
            compare(testing::law::erased_others);
        }
    }
    /// Without any rebuild, past every capacity that a table may start with.
    void grow_by_assign() {
        clear();
        for (std::size_t k = 0; k < 3000; ++k) {
            assign(static_cast<id_type>(k * 7), static_cast<index_t>(k), false);
            if (k % 3 == 0) erase(static_cast<id_type>(random_.below(7 * k + 7)), false);
        }
        compare(testing::law::assigned_others);
    }
    void clear() {
        subject_.clear();
        model_.clear();
        compare(testing::law::cleared);
    }
    void reserve(std::size_t count) {
        try {
            subject_.reserve(count);
        } catch (const limit_error&) {
            return compare(testing::law::strong);
        }
        compare(testing::law::reserved);
    }
    void copy_and_move() {
        const auto kept = model_;
        Storage copy(subject_);
        compare(copy, kept, testing::law::copied);
        // Writes to the source, then to the copy; each in turn must leave the other alone.
        write_some(6);
        compare(copy, kept, testing::law::copied);
        copy.clear();
        copy.assign(id_type{3}, 1);
        compare(testing::law::copied);

        Storage other(prototype_);
        other = subject_;
        auto& same = other;
        other = same;
        compare(other, model_, testing::law::copied);
        Storage moved(std::move(other));
        compare(moved, model_, testing::law::moved);
        other = copy;  // NOLINT(bugprone-use-after-move): law 9
        model_type one;
        one.assign(id_type{3}, 1);
        compare(other, one, testing::law::moved);
        copy = std::move(moved);
        compare(copy, model_, testing::law::moved);
        moved = std::move(copy);
        compare(moved, model_, testing::law::moved);
        subject_ = std::move(moved);  // the run goes on in it
        compare(testing::law::moved);
        if (random_.below(2) == 0) {
            moved = Storage(prototype_);
            compare(moved, model_type(), testing::law::moved);
        }
    }

    // --- without memory ---------------------------------------------------------------------------------------

    /// Makes every allocation of one call fail in turn: alone, and with all that follow it.
    /// call(storage) may throw; after(storage, failed) looks at what it did.
    template <class Call, class After>
    void fail_each(testing::allocation_gate& gate, Call&& call, After&& after) {
        constexpr std::size_t most = 200;  // a call with more allocations than that is looked at no further
        for (const bool alone : {true, false}) {
            for (std::size_t k = 0; k < most; ++k) {
                Storage victim(subject_);
                bool failed = false;
                if (alone)
                    gate.refuse_at(k);
                else
                    gate.refuse_from(k);
                try {
                    call(victim);
                } catch (const std::bad_alloc&) {
                    failed = true;
                } catch (const limit_error&) {
                    failed = true;
                }
                const bool refused = gate.refused() != 0;
                gate.open();
                after(victim, failed);
                if (!refused) break;
            }
        }
    }
    void fail_rebuild(testing::allocation_gate& gate) {
        pattern_ = static_cast<testing::id_pattern>(random_.below(testing::id_pattern_count));
        rebuild(testing::make_ids<id_type>(pattern_, random_.below(3) == 0 ? 1000 : random_.below(300), random_));
        write_some(8);
        pattern_ = static_cast<testing::id_pattern>(random_.below(testing::id_pattern_count));
        const auto ids =
            testing::make_ids<id_type>(pattern_, random_.below(3) == 0 ? 2001 : random_.below(900), random_);
        const std::span<const id_type> span(ids);
        model_type changed;
        const auto expected = changed.rebuild(span);
        poisoned_links links(ids.size(), random_);
        const auto after = [&](Storage& victim, bool failed) {
            if (failed) {
                compare(victim, model_, testing::law::strong);
                expect(links.untouched(), testing::law::strong_links);
                try {
                    victim.rebuild(span, range_of(span), links.span());
                } catch (const limit_error&) {
                    return;
                }
            }
            check_links(links, true, expected, failed ? testing::law::recovers : testing::law::links);
            compare(victim, changed, failed ? testing::law::recovers : testing::law::lookup);
            links = poisoned_links(ids.size(), random_);
        };
        fail_each(
            gate, [&](Storage& victim) { victim.rebuild(span, range_of(span), links.span()); }, after);
        if constexpr (parallel_rebuild<Storage>)
            fail_each(
                gate, [&](Storage& victim) { victim.rebuild(span, range_of(span), links.span(), threads(2)); }, after);
    }
    void fail_reserve(testing::allocation_gate& gate) {
        const auto count = random_.below(20'000);
        fail_each(
            gate, [&](Storage& victim) { victim.reserve(count); },
            [&](Storage& victim, bool failed) {
                compare(victim, model_, failed ? testing::law::strong : testing::law::reserved);
            });
    }
    /// A table that grows one id at a time; each time it asks for memory, it is refused some of it.
    void fail_assign(testing::allocation_gate& gate) {
        const auto kept = model_;
        Storage victim(subject_);
        const auto first = random_.below(1000);
        const auto stride = 1 + random_.below(40);
        std::size_t number = 0;
        for (std::size_t k = 0; k < 1500; ++k) {
            const auto t = static_cast<id_type>(first + stride * k);
            const auto index = random_.below(64) == 0 ? some_index() : static_cast<index_t>(k);
            bool failed = false;
            if (random_.below(2) == 0)
                gate.refuse_at(number % 4);
            else
                gate.refuse_from(number % 4);
            try {
                victim.assign(t, index);
            } catch (const std::bad_alloc&) {
                failed = true;
            } catch (const limit_error&) {
                gate.open();
                compare(victim, model_, testing::law::strong);
                continue;
            }
            const bool asked = gate.asked() != 0;
            gate.open();
            if (asked) ++number;
            if (failed) {
                compare(victim, model_, testing::law::strong);
                victim.assign(t, index);
            }
            model_.assign(t, index);
            if (failed) compare(victim, model_, testing::law::recovers);
        }
        compare(victim, model_, testing::law::assigned_others);
        model_ = kept;
    }
    void assign_without_memory(testing::allocation_gate& gate) {
        if (former_.empty() || !rebuild(std::vector<id_type>(former_))) return;
        bool taken = true;
        for (std::size_t k = 0; k < 50 && taken; ++k) {
            const auto t = former_[random_.below(former_.size())];
            const auto index = static_cast<index_t>(random_.below(former_.size()));
            gate.refuse_from(0);
            try {
                subject_.assign(t, index);
            } catch (const std::bad_alloc&) {
                taken = false;
            }
            gate.open();
            if (taken) model_.assign(t, index);
        }
        expect(taken, testing::law::no_memory);
        compare(testing::law::assigned_others);
    }

    static constexpr std::uint64_t no_blame = 0x5eed5eed5eed5eedU;  // a value that no pattern makes

    std::uint64_t seed_;
    std::size_t step_ = 0;
    random_stream random_;
    Check& check_;
    Storage prototype_;
    Storage subject_;
    model_type model_;
    std::vector<id_type> former_;  // what the last rebuild was given
    testing::id_pattern pattern_ = testing::id_pattern::lattice;
    std::uint64_t blamed_ = no_blame;
};

}  // namespace tsubu::detail

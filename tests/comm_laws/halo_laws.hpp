// SPDX-License-Identifier: MIT
/// @file
/// What make_halo promises, as checks over any transport: every rank knows all particles, and looks for their images
/// one by one.
#pragma once

#include <tsubu/comm/halo.hpp>

#include "comm_laws/known_particles.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace comm_laws {

/// All particles, on their ranks, and the halo of this one.
template <class Parts, class Transport, class Pattern, class Check, class Layout = tsubu::soa>
class ghosts_of {
    static constexpr auto D = Parts::dimension;
    using Scalar = typename Parts::scalar_type;
    using Real = typename Parts::real_type;
    using box_type = typename Parts::box_type;
    using position_type = typename Parts::position_type;
    using real_position = tsubu::vec<D, Real>;
    using shift_type = tsubu::image_shift<D>;
    using key = std::pair<std::int64_t, shift_type>;
    static constexpr auto position = tsubu::position<D, Scalar>;
    static constexpr auto velocity = tsubu::velocity<D, Real>;
    static constexpr auto force = tsubu::force<D, Real>;
    static constexpr bool is_domain =
        std::is_same_v<box_type, std::remove_cvref_t<decltype(std::declval<box_type>().cell())>>;
    static constexpr bool is_staged = std::is_same_v<Pattern, tsubu::staged_pattern>;

public:
    using store_type = known_store<Parts, Layout>;

    ghosts_of(const Parts& parts, Transport& on, const Pattern& pattern, Real cutoff, std::uint64_t seed,
              std::size_t count, Check& check)
        : parts_(parts), on_(on), pattern_(pattern), cutoff_(cutoff), seed_(seed), check_(check) {
        all_ = points_in(parts.whole(), count, seed);
        // Some on the corners of ranks.
        if constexpr (!tsubu::is_lattice<Scalar>)
            for (std::size_t t = 0; t + 1 < count && t < parts.ranks(); t += 2) {
                const auto x = parts.whole().from_cell(parts.subdomain(t).lo());
                if (parts.whole().contains(x)) all_[t] = x;
            }
        for (std::size_t t = 0; t < count; ++t) {
            home_.push_back(parts.owner(all_[t]));
            if (home_[t] == on.rank()) add_known<Parts>(store_, static_cast<std::int64_t>(t), all_[t]);
        }
    }

    void examine() {
        store_.add_ghosts(3);  // of before
        auto made = tsubu::make_halo(store_, parts_, cutoff_, on_, pattern_);
        auto halo = std::move(made);  // it may be moved
        const bool counts = halo.owned_count() == store_.owned_count() && halo.ghost_count() == store_.ghost_count() &&
                            halo.shifts().size() == halo.ghost_count();
        expect(counts, "halo: the counts are those of the store");
        if (!counts) return;
        examine_images(halo);
        examine_creation(halo);
        examine_forward(halo);
        examine_reverse(halo);
        examine_both_ways(halo);
        examine_halves(halo);
        examine_messages(halo);
        examine_stale(halo);
    }
    void examine_refusals(const Parts& of_more) {
        const auto refuses = [&](const auto& parts, Real cutoff) {
            store_.clear_ghosts();
            store_.add_ghosts(1);
            try {
                static_cast<void>(tsubu::make_halo(store_, parts, cutoff, on_, pattern_));
            } catch (const tsubu::input_error&) {
                return store_.ghost_count() == 0;
            }
            return false;
        };
        expect(refuses(parts_, -1), "halo: a negative cutoff is refused on all ranks, and there are no ghosts");
        expect(refuses(parts_, std::numeric_limits<Real>::quiet_NaN()), "halo: a NaN as cutoff is refused");
        expect(refuses(parts_, std::numeric_limits<Real>::infinity()), "halo: an infinite cutoff is refused");
        expect(refuses(of_more, cutoff_), "halo: a decomposition for other ranks is refused");
        // What one rank alone finds, all are told.
        expect(refuses(parts_, on_.rank() + 1 == on_.ranks() ? Real{-1} : cutoff_),
               "halo: what one rank refuses is refused on all");
        auto halo = tsubu::make_halo(store_, parts_, cutoff_, on_, pattern_);
        examine_images(halo);
    }

private:
    [[nodiscard]] const box_type& box() const { return parts_.whole(); }
    [[nodiscard]] static shift_type no_shift() { return {}; }
    /// The one name of an image that has several: in a wedge.
    [[nodiscard]] shift_type named(const shift_type& shift) const {
        if constexpr (tsubu::cyclic_box<box_type>)
            return box().same_image(shift);
        else
            return shift;
    }
    [[nodiscard]] std::int64_t id_of(std::size_t ghost) const {
        return store_[tsubu::id][store_.owned_count() + ghost];
    }

    template <class Halo>
    void examine_images(const Halo& halo) {
        std::vector<key> have;
        for (std::size_t k = 0; k < halo.ghost_count(); ++k) have.emplace_back(id_of(k), named(halo.shift(k)));
        std::sort(have.begin(), have.end());
        expect(std::adjacent_find(have.begin(), have.end()) == have.end(), "halo: no image is there twice");
        bool is_known = true;
        bool is_other = true;
        for (const auto& [t, shift] : have) {
            is_known = is_known && t >= 0 && static_cast<std::size_t>(t) < all_.size();
            is_other = is_other && is_known &&
                       !(home_[static_cast<std::size_t>(t)] == on_.rank() && shift == no_shift());
        }
        expect(is_known, "halo: ghosts have ids of particles");
        expect(is_other, "halo: no particle is a ghost of itself");
        bool is_complete = true;
        bool is_near = true;
        std::size_t must = 0;
        each_image([&](std::size_t t, const shift_type& shift, const real_position& x) {
            const auto where = nearness(x);
            const bool is_there =
                std::binary_search(have.begin(), have.end(), key(static_cast<std::int64_t>(t), named(shift)));
            must += where == near ? 1U : 0U;
            is_complete = is_complete && (where != near || is_there);
            is_near = is_near && (where != far || !is_there);
        });
        expect(is_complete, "halo: every image within the cutoff is there");
        expect(is_near, "halo: no image beyond the cutoff is there");
        if constexpr (is_domain) expect(must <= have.size(), "halo: there is no shift but of periods that are near");
        if constexpr (!is_staged) {
            bool by_rank = true;
            for (std::size_t k = 1; is_known && k < halo.ghost_count(); ++k)
                by_rank = by_rank && home_[static_cast<std::size_t>(id_of(k - 1))] <=
                                         home_[static_cast<std::size_t>(id_of(k))];
            expect(by_rank, "halo: ghosts are in the order of their owners' ranks");
        }
    }

    enum nearness_type { near, on_the_edge, far };
    /// Of an image to the subdomain of this rank; in boxes that are not a domain, to its particles.
    [[nodiscard]] nearness_type nearness(const real_position& x) const {
        constexpr auto rounding = 256 * static_cast<long double>(std::numeric_limits<Real>::epsilon());
        long double least = std::numeric_limits<long double>::infinity();
        if constexpr (is_domain) {
            const auto mine = parts_.subdomain(on_.rank());
            long double square = 0;
            long double largest = 0;
            for (std::size_t k = 0; k < D; ++k) {
                const auto gap = (std::max)({static_cast<long double>(mine.lo()[k]) - x[k],
                                             static_cast<long double>(x[k]) - mine.hi()[k], 0.0L});
                square += gap * gap;
                largest = (std::max)(largest, gap);
            }
            least = is_staged ? largest : std::sqrt(square);
            if (least > cutoff_ + rounding * (1 + cutoff_)) return far;
        } else {
            for (std::size_t i = 0; i < store_.owned_count(); ++i) {
                long double square = 0;
                for (std::size_t k = 0; k < D; ++k) {
                    const auto gap = static_cast<long double>(x[k]) - store_[position][i][k];
                    square += gap * gap;
                }
                least = (std::min)(least, std::sqrt(square));
            }
        }
        return least < cutoff_ - rounding * (1 + cutoff_) || (least == 0 && is_domain) ? near : on_the_edge;
    }
    /// body(t, shift, x) for all images that could be near, but for the particles of this rank themselves.
    template <class Body>
    void each_image(Body&& body) const {
        shift_type most{};
        shift_type least{};
        if constexpr (is_domain) {
            for (std::size_t k = 0; k < D; ++k)
                if (box().along(k).is_periodic())
                    most[k] = static_cast<std::int64_t>(cutoff_ / box().along(k).length()) + 2;
        } else {
            const auto mine = parts_.subdomain(on_.rank());
            const auto reach = box().cell_reach(cutoff_, mine, mine);
            for (std::size_t k = 0; k < D; ++k)
                if (box().cell().along(k).is_periodic())
                    most[k] = static_cast<std::int64_t>(reach[k] / box().cell().along(k).length()) + 2;
        }
        for (std::size_t k = 0; k < D; ++k) least[k] = -most[k];
        if constexpr (tsubu::cyclic_box<box_type>) {
            least[0] = 0;
            most[0] = static_cast<std::int64_t>(box().sectors()) - 1;
        }
        auto shift = least;
        for (;;) {
            for (std::size_t t = 0; t < all_.size(); ++t)
                if (home_[t] != on_.rank() || shift != no_shift()) body(t, shift, box().image(all_[t], shift));
            std::size_t k = 0;
            while (k < D && shift[k] == most[k]) {
                shift[k] = least[k];
                ++k;
            }
            if (k == D) return;
            ++shift[k];
        }
    }

    /// @param at  where all particles are
    template <class Halo>
    [[nodiscard]] bool are_images(const Halo& halo, const std::vector<position_type>& at) const {
        const auto rounding = 64 * std::numeric_limits<Real>::epsilon() * (3 + 2 * cutoff_);
        bool is_image = true;
        for (std::size_t k = 0; k < halo.ghost_count(); ++k) {
            const auto& x = store_[position][store_.owned_count() + k];
            const auto& from = at[static_cast<std::size_t>(id_of(k))];
            if constexpr (tsubu::is_lattice<Scalar>) {
                is_image = is_image && x == from;
            } else {
                const auto wanted = box().image(from, halo.shift(k));
                // By several steps rounding adds up.
                for (std::size_t d = 0; d < D; ++d)
                    is_image = is_image && std::abs(x[d] - wanted[d]) <= (is_staged || !is_domain ? rounding : 0);
            }
        }
        return is_image;
    }
    template <class Halo>
    [[nodiscard]] bool are_turned(const Halo& halo, Real scale) const {
        bool is_turned = true;
        for (std::size_t k = 0; k < halo.ghost_count(); ++k) {
            auto v = velocity_of<D, Real>(id_of(k));
            for (auto& one : v) one *= scale;
            const auto& here = store_[velocity][store_.owned_count() + k];
            is_turned = is_turned && are_near(here, turned(box(), v, halo.shift(k)));
        }
        return is_turned;
    }
    [[nodiscard]] static bool are_near(const real_position& a, const real_position& b) {
        Real size = 0;
        for (std::size_t d = 0; d < D; ++d) size += std::abs(a[d]) + std::abs(b[d]);
        for (std::size_t d = 0; d < D; ++d)
            if (std::abs(a[d] - b[d]) > 64 * std::numeric_limits<Real>::epsilon() * size) return false;
        return true;
    }

    template <class Halo>
    void examine_creation(const Halo& halo) {
        expect(are_images(halo, all_), "halo: positions arrive moved into the image");
        expect(are_turned(halo, 1), "halo: vectors arrive turned into the image");
        bool has_lists = true;
        bool has_others = true;
        bool is_hidden = true;
        for (std::size_t k = 0; k < halo.ghost_count(); ++k) {
            const auto i = store_.owned_count() + k;
            has_lists = has_lists && carries_its_own(store_, i, id_of(k));
            has_others = has_others && store_[tally][i] == 1000.0 + static_cast<double>(id_of(k));
            is_hidden = is_hidden && store_[hidden][i] == 0 && store_[force][i] == real_position{};
        }
        expect(has_lists, "halo: lists and bonus values travel on creation");
        expect(has_others, "halo: other fields travel on creation");
        expect(is_hidden, "halo: what never travels is zero");
    }
    template <class Halo>
    void examine_forward(Halo& halo) {
        auto moved = all_;
        for (std::size_t t = 0; t < moved.size(); ++t) moved[t] = beside(all_[t], t);
        for (std::size_t i = 0; i < store_.owned_count(); ++i) {
            const auto t = store_[tsubu::id][i];
            store_[position][i] = moved[static_cast<std::size_t>(t)];
            for (auto& one : store_[velocity][i]) one *= 2;
            store_[tally][i] = -3.0 * static_cast<double>(t);
            store_[hidden][i] = -1;
        }
        halo.forward(store_, position, velocity);
        expect(are_images(halo, moved) && are_turned(halo, 2), "halo: forward brings several fields at once");
        halo.forward(store_, tally);
        bool has_tally = true;
        bool is_hidden = true;
        for (std::size_t k = 0; k < halo.ghost_count(); ++k) {
            has_tally = has_tally &&
                        store_[tally][store_.owned_count() + k] == -3.0 * static_cast<double>(id_of(k));
            is_hidden = is_hidden && store_[hidden][store_.owned_count() + k] == 0;
        }
        expect(has_tally, "halo: forward brings a field of another size");
        expect(is_hidden, "halo: forward brings no other fields");
        for (std::size_t i = 0; i < store_.owned_count(); ++i)
            store_[position][i] = all_[static_cast<std::size_t>(store_[tsubu::id][i])];
        halo.forward(store_, position);
        expect(are_images(halo, all_), "halo: forward can be called again, with fewer fields");
    }
    [[nodiscard]] static position_type beside(position_type x, std::size_t t) {
        for (auto& one : x) {
            if constexpr (tsubu::is_lattice<Scalar>)
                one = one + static_cast<decltype(one.value)>(1 + t);
            else
                one += static_cast<Scalar>(1e-3 * static_cast<double>(t + 1));
        }
        return x;
    }

    /// What a ghost adds: whole numbers, whose sums do not round.
    [[nodiscard]] std::int64_t weight(std::size_t ghost) const {
        return 1 + static_cast<std::int64_t>(tsubu::splitmix64(seed_ + 131 * ghost + on_.rank()) % 97);
    }
    template <class Halo>
    void examine_reverse(Halo& halo) {
        struct total {
            std::int64_t sum = 0;
            std::int64_t count = 0;
            std::int64_t least = 1'000;
            std::int64_t greatest = -1'000;
        };
        // What all ghosts of all ranks hold, by particle.
        std::vector<std::uint64_t> told;
        for (std::size_t k = 0; k < halo.ghost_count(); ++k) {
            told.push_back(static_cast<std::uint64_t>(id_of(k)));
            told.push_back(static_cast<std::uint64_t>(weight(k)));
        }
        std::vector<total> of(all_.size());
        const auto all_told = on_.gather(told);
        for (const auto& [from, words] : all_told)
            for (std::size_t k = 0; k + 1 < words.size(); k += 2) {
                auto& one = of[static_cast<std::size_t>(words[k])];
                const auto w = static_cast<std::int64_t>(words[k + 1]);
                one.sum += w;
                ++one.count;
                one.least = (std::min)(one.least, 50 - w);
                one.greatest = (std::max)(one.greatest, w - 50);
            }
        const auto set = [&](std::size_t i, std::int64_t w, const shift_type& shift, std::int64_t t) {
            store_[tally][i] = static_cast<double>(w);
            store_[lowest][i] = static_cast<std::int32_t>(50 - w);
            store_[highest][i] = {static_cast<float>(w - 50), static_cast<float>(t)};
            auto v = velocity_of<D, Real>(t);
            for (auto& one : v) one *= static_cast<Real>(w);
            store_[force][i] = turned(box(), v, shift);
        };
        for (std::size_t i = 0; i < store_.owned_count(); ++i) set(i, 50, {}, store_[tsubu::id][i]);
        for (std::size_t k = 0; k < halo.ghost_count(); ++k)
            set(store_.owned_count() + k, weight(k), halo.shift(k), id_of(k));
        halo.reverse(store_, force, tally, lowest, highest);
        bool is_sum = true;
        bool is_vector_sum = true;
        bool is_least = true;
        bool is_greatest = true;
        for (std::size_t i = 0; i < store_.owned_count(); ++i) {
            const auto t = store_[tsubu::id][i];
            const auto& wanted = of[static_cast<std::size_t>(t)];
            is_sum = is_sum && store_[tally][i] == static_cast<double>(50 + wanted.sum);
            auto v = velocity_of<D, Real>(t);
            for (auto& one : v) one *= static_cast<Real>(50 + wanted.sum);
            is_vector_sum = is_vector_sum && are_near(store_[force][i], v);
            is_least = is_least && store_[lowest][i] == (std::min)(std::int64_t{0}, wanted.least);
            const auto greatest = static_cast<float>((std::max)(std::int64_t{0}, wanted.greatest));
            is_greatest = is_greatest && store_[highest][i] == tsubu::vec<2, float>{greatest, static_cast<float>(t)};
        }
        expect(is_sum, "halo: reverse adds what each ghost holds to its owner, once");
        expect(is_vector_sum, "halo: reverse turns vectors back");
        expect(is_least && is_greatest, "halo: reverse takes the least and the greatest");
        if constexpr (!is_staged) {
            bool is_kept = true;
            for (std::size_t k = 0; k < halo.ghost_count(); ++k)
                is_kept = is_kept && store_[tally][store_.owned_count() + k] == static_cast<double>(weight(k));
            expect(is_kept, "halo: ghosts keep what they hold");
        }
    }
    /// Forward, then reverse: each owner has its value once more for each ghost, and the sum over all is conserved.
    template <class Halo>
    void examine_both_ways(Halo& halo) {
        for (std::size_t i = 0; i < store_.owned_count(); ++i)
            store_[tally][i] = 0.1 * static_cast<double>(store_[tsubu::id][i] + 1);
        halo.forward(store_, tally);
        const auto sum = [&](std::size_t first, std::size_t last) {
            double all = 0;
            for (auto i = first; i < last; ++i) all += store_[tally][i];
            return all;
        };
        double sums[] = {sum(0, store_.size()), 0};
        halo.reverse(store_, tally);
        sums[1] = sum(0, store_.owned_count());
        on_.reduce(std::span<double>(sums), tsubu::reduction::sum);
        expect(std::abs(sums[0] - sums[1]) <= 1e-13 * std::abs(sums[0]), "halo: reverse conserves the sum over all");
    }
    /// Other work between the halves.
    template <class Halo>
    void examine_halves(Halo& halo) {
        const auto put = [&](double factor) {
            for (std::size_t i = 0; i < store_.owned_count(); ++i)
                store_[tally][i] = factor * static_cast<double>(store_[tsubu::id][i]);
        };
        put(5);
        halo.start_forward(store_, tally);
        if constexpr (!is_staged) put(7);
        halo.finish_forward(store_, tally);
        bool is_of_start = true;
        for (std::size_t k = 0; k < halo.ghost_count(); ++k)
            is_of_start = is_of_start && store_[tally][store_.owned_count() + k] == 5 * static_cast<double>(id_of(k));
        expect(is_of_start, "halo: the first half of forward takes the values, the second half brings them");
        for (std::size_t k = 0; k < halo.ghost_count(); ++k) store_[tally][store_.owned_count() + k] = 1;
        put(0);
        halo.start_reverse(store_, tally);
        for (std::size_t i = 0; i < store_.owned_count(); ++i) store_[tally][i] += 2;  // before others add to it
        halo.finish_reverse(store_, tally);
        double sums[] = {0, static_cast<double>(halo.ghost_count() + 2 * store_.owned_count())};
        for (std::size_t i = 0; i < store_.owned_count(); ++i) sums[0] += store_[tally][i];
        on_.reduce(std::span<double>(sums), tsubu::reduction::sum);
        expect(sums[0] == sums[1], "halo: owners may be added to between the halves of reverse");
    }
    template <class Halo>
    void examine_messages(const Halo& halo) {
        std::uint64_t sums[] = {halo.sent_count(), halo.ghost_count(), halo.sent_messages(), halo.received_messages()};
        on_.reduce(std::span<std::uint64_t>(sums), tsubu::reduction::sum);
        expect(sums[0] == sums[1], "halo: as many are sent as there are ghosts");
        expect(sums[2] == sums[3], "halo: as many messages are sent as come");
        if constexpr (!is_staged) {
            std::vector<bool> is_met(on_.ranks(), false);
            for (std::size_t k = 0; k < halo.ghost_count(); ++k)
                is_met[home_[static_cast<std::size_t>(id_of(k))]] = true;
            is_met[on_.rank()] = false;
            expect(halo.received_messages() == static_cast<std::size_t>(std::count(is_met.begin(), is_met.end(), true)),
                   "halo: one message comes from each other rank that owns ghosts of this one");
        }
    }
    /// After particles have come or gone.
    template <class Halo>
    void examine_stale(Halo& halo) {
        const auto refuses = [&](auto&& use) {
            try {
                use();
            } catch (const tsubu::input_error&) {
                return true;
            }
            return false;
        };
        store_.add_ghosts(1);
        expect(refuses([&] { halo.forward(store_, tally); }) && refuses([&] { halo.reverse(store_, tally); }),
               "halo: a store with other ghosts is refused");
        store_.clear_ghosts();
        store_.push_back();
        expect(refuses([&] { halo.forward(store_, tally); }) && refuses([&] { halo.finish_forward(store_, tally); }),
               "halo: a store with other particles is refused");
        store_.swap_remove(store_.owned_count() - 1);
    }

    void expect(bool kept, const char* law) {
        if (kept) return check_(true, std::string_view(law));
        check_(false, std::string_view(std::string(law) + "; rank " + std::to_string(on_.rank()) + " of " +
                                       std::to_string(on_.ranks()) + ", D = " + std::to_string(D) + ", cutoff " +
                                       std::to_string(static_cast<double>(cutoff_)) + ", seed " +
                                       std::to_string(seed_)));
    }

    const Parts& parts_;
    Transport& on_;
    Pattern pattern_;
    Real cutoff_;
    std::uint64_t seed_;
    Check& check_;
    store_type store_;
    std::vector<position_type> all_;
    std::vector<tsubu::rank_t> home_;
};

/// As many particles as leave some thousand images.
[[nodiscard]] inline std::size_t count_for(double cutoff) { return cutoff < 0.2 ? 90 : cutoff < 1 ? 50 : 14; }

template <class Layout = tsubu::soa, class Parts, class Transport, class Pattern, class Check>
void ghosts_are_images(const Parts& parts, Transport& on, const Pattern& pattern, double cutoff, Check& check) {
    using real = typename Parts::real_type;
    ghosts_of<Parts, Transport, Pattern, Check, Layout> all(parts, on, pattern, static_cast<real>(cutoff),
                                                            11 + on.ranks(), count_for(cutoff), check);
    all.examine();
}
/// The same by all patterns that take these parts.
template <class Layout = tsubu::soa, class Parts, class Transport, class Check>
void ghosts_are_images(const Parts& parts, Transport& on, double cutoff, Check& check) {
    ghosts_are_images<Layout>(parts, on, tsubu::direct_pattern{}, cutoff, check);
    if constexpr (tsubu::halo_pattern<tsubu::staged_pattern, Parts>)
        ghosts_are_images<Layout>(parts, on, tsubu::staged_pattern{}, cutoff, check);
}

}  // namespace comm_laws

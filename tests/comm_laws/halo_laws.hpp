// SPDX-License-Identifier: MIT
/// @file
/// What make_halo promises, as checks over any transport: every rank knows all particles, and looks for their images
/// one by one.
#pragma once

#include <tsubu/comm/halo.hpp>

#include "comm_laws/known_particles.hpp"
#include "support/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace comm_laws {

/// What a halo has to keep, told to a verdict with where it was broken.
class halo_verdict {
public:
    halo_verdict(verdict& seen, std::string where) : seen_(&seen), where_(std::move(where)) {}
    void expect(bool kept, const char* law) { (*seen_)(kept, kept ? std::string(law) : law + where_); }

private:
    verdict* seen_;
    std::string where_;
};

/// An image by the particle and the shift, of which a line or a plane has fewer numbers.
struct image_name {
    std::int64_t id;
    tsubu::image_shift<3> shift;
    friend auto operator<=>(const image_name&, const image_name&) = default;
};
template <std::size_t D>
[[nodiscard]] image_name name_of(std::int64_t t, const tsubu::image_shift<D>& shift) {
    image_name name{t, {}};
    std::copy(shift.begin(), shift.end(), name.shift.begin());
    return name;
}
enum class nearness { near, on_the_edge, far };
struct known_image {
    image_name name;
    nearness where;
};

/// @param have  the ghosts of this rank
/// @param images  all that could be near, each once, but for the particles of this rank themselves
/// @param home  of all particles
inline void examine_names(std::vector<image_name> have, const std::vector<known_image>& images,
                          const std::vector<tsubu::rank_t>& home, tsubu::rank_t rank, bool is_direct,
                          halo_verdict& judge) {
    bool is_known = true;
    bool is_other = true;
    bool by_rank = true;
    for (std::size_t k = 0; k < have.size(); ++k) {
        const auto& [t, shift] = have[k];
        is_known = is_known && t >= 0 && static_cast<std::size_t>(t) < home.size();
        if (!is_known) break;
        const auto owner = home[static_cast<std::size_t>(t)];
        is_other = is_other && !(owner == rank && shift == tsubu::image_shift<3>{});
        by_rank = by_rank && (k == 0 || home[static_cast<std::size_t>(have[k - 1].id)] <= owner);
    }
    judge.expect(is_known, "halo: ghosts have ids of particles");
    judge.expect(is_other, "halo: no particle is a ghost of itself");
    if (is_direct) judge.expect(by_rank, "halo: ghosts are in the order of their owners' ranks");
    std::sort(have.begin(), have.end());
    judge.expect(std::adjacent_find(have.begin(), have.end()) == have.end(), "halo: no image is there twice");
    bool is_complete = true;
    bool is_near = true;
    std::size_t listed = 0;
    for (const auto& [name, where] : images) {
        const bool is_there = std::binary_search(have.begin(), have.end(), name);
        listed += is_there ? 1U : 0U;
        is_complete = is_complete && (where != nearness::near || is_there);
        is_near = is_near && (where != nearness::far || !is_there);
    }
    judge.expect(is_complete, "halo: every image within the cutoff is there");
    judge.expect(is_near && listed == have.size(), "halo: no image beyond the cutoff is there");
}

/// The one name of an image that has several: in a wedge.
template <class Box>
[[nodiscard]] tsubu::image_shift<Box::dimension> same_image(const Box& where,
                                                            const tsubu::image_shift<Box::dimension>& shift) {
    if constexpr (tsubu::cyclic_box<Box>)
        return where.same_image(shift);
    else
        return shift;
}

/// Where particles are, and which of their images are near one rank, of all that could be.
template <class Box>
class all_images {
    static constexpr auto D = Box::dimension;
    using real_type = typename Box::real_type;
    using position_type = typename Box::position_type;
    using real_position = tsubu::vec<D, real_type>;
    using shift_type = tsubu::image_shift<D>;

public:
    static constexpr bool is_domain =
        std::is_same_v<Box, std::remove_cvref_t<decltype(std::declval<Box>().cell())>>;

    /// @param mine  the subdomain that asks
    template <class Part>
    all_images(const Box& where, const Part& mine, double cutoff, bool is_staged)
        : box_(where), cutoff_(cutoff), is_staged_(is_staged) {
        for (std::size_t k = 0; k < D; ++k) {
            lo_[k] = mine.lo()[k];
            hi_[k] = mine.hi()[k];
            if (!where.cell().along(k).is_periodic()) continue;
            auto reach = static_cast<real_type>(cutoff);
            if constexpr (!is_domain) reach = where.cell_reach(reach, mine, mine)[k];
            // One period more reaches from beyond the other face.
            most_[k] = static_cast<std::int64_t>(reach / where.cell().along(k).length()) + 1;
            least_[k] = -most_[k];
        }
        if constexpr (tsubu::cyclic_box<Box>) {
            least_[0] = 0;
            most_[0] = static_cast<std::int64_t>(where.sectors()) - 1;
        }
    }
    /// Of all but the particles of this rank themselves.
    [[nodiscard]] std::vector<known_image> of(const std::vector<position_type>& all,
                                              const std::vector<tsubu::rank_t>& home, tsubu::rank_t rank) const {
        std::vector<position_type> here;
        for (std::size_t t = 0; t < all.size(); ++t)
            if (home[t] == rank) here.push_back(all[t]);
        std::vector<known_image> images;
        auto shift = least_;
        for (;;) {
            for (std::size_t t = 0; t < all.size(); ++t)
                if (home[t] != rank || shift != shift_type{})
                    images.push_back({name_of(static_cast<std::int64_t>(t), same_image(box_, shift)),
                                      nearness_of(box_.image(all[t], shift), here)});
            std::size_t k = 0;
            while (k < D && shift[k] == most_[k]) {
                shift[k] = least_[k];
                ++k;
            }
            if (k == D) return images;
            ++shift[k];
        }
    }

private:
    /// To the subdomain; in boxes that are not a domain, to the particles here.
    [[nodiscard]] nearness nearness_of(const real_position& x, const std::vector<position_type>& here) const {
        constexpr auto rounding = 256 * static_cast<long double>(std::numeric_limits<real_type>::epsilon());
        long double least = std::numeric_limits<long double>::infinity();
        if constexpr (is_domain) {
            static_cast<void>(here);
            long double square = 0;
            long double largest = 0;
            for (std::size_t k = 0; k < D; ++k) {
                const auto at = static_cast<long double>(x[k]);
                const auto gap = at < lo_[k] ? lo_[k] - at : at > hi_[k] ? at - hi_[k] : 0.0L;
                square += gap * gap;
                largest = gap > largest ? gap : largest;
            }
            least = is_staged_ ? largest : std::sqrt(square);
            if (least > cutoff_ + rounding * (1 + cutoff_)) return nearness::far;
        } else {
            for (const auto& one : here) {
                long double square = 0;
                for (std::size_t k = 0; k < D; ++k) {
                    const auto gap = static_cast<long double>(x[k]) - one[k];
                    square += gap * gap;
                }
                least = (std::min)(least, std::sqrt(square));
            }
        }
        return least < cutoff_ - rounding * (1 + cutoff_) || (least == 0 && is_domain) ? nearness::near
                                                                                       : nearness::on_the_edge;
    }

    const Box& box_;
    long double cutoff_;
    bool is_staged_;
    real_position lo_{};
    real_position hi_{};
    shift_type least_{};
    shift_type most_{};
};

/// By which pattern.
enum class passed { directly, in_stages };

/// All particles, on their ranks, and the halo of this one.
template <class Parts, class Transport, class Layout = tsubu::soa>
class ghosts_of {
    static constexpr auto D = Parts::dimension;
    using Scalar = typename Parts::scalar_type;
    using Real = typename Parts::real_type;
    using box_type = typename Parts::box_type;
    using position_type = typename Parts::position_type;
    using real_position = tsubu::vec<D, Real>;
    using shift_type = tsubu::image_shift<D>;
    using halo_type = tsubu::halo<Parts, Transport>;
    static constexpr auto position = tsubu::position<D, Scalar>;
    static constexpr auto velocity = tsubu::velocity<D, Real>;
    static constexpr auto force = tsubu::force<D, Real>;
    static constexpr bool is_domain = all_images<box_type>::is_domain;

public:
    using store_type = known_store<Parts, Layout>;

    ghosts_of(const Parts& parts, Transport& on, passed how, double cutoff, std::uint64_t seed, std::size_t count,
              verdict& seen)
        : parts_(parts),
          on_(on),
          is_staged_(how == passed::in_stages),
          cutoff_(static_cast<Real>(cutoff)),
          seed_(seed),
          judge_(seen, "; rank " + std::to_string(on.rank()) + " of " + std::to_string(on.ranks()) +
                           ", D = " + std::to_string(D) + ", cutoff " + std::to_string(cutoff) + ", seed " +
                           std::to_string(seed)) {
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
        auto made = make(parts_, cutoff_);
        auto halo = std::move(made);  // it may be moved
        const bool counts = halo.owned_count() == store_.owned_count() && halo.ghost_count() == store_.ghost_count() &&
                            halo.shifts().size() == halo.ghost_count();
        judge_.expect(counts, "halo: the counts are those of the store");
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
        const auto refuses = [&](const Parts& parts, Real cutoff) {
            store_.clear_ghosts();
            store_.add_ghosts(1);
            try {
                static_cast<void>(make(parts, cutoff));
            } catch (const tsubu::input_error&) {
                return store_.ghost_count() == 0;
            }
            return false;
        };
        judge_.expect(refuses(parts_, -1), "halo: a negative cutoff is refused on all ranks, and there are no ghosts");
        judge_.expect(refuses(parts_, std::numeric_limits<Real>::quiet_NaN()), "halo: a NaN as cutoff is refused");
        judge_.expect(refuses(parts_, std::numeric_limits<Real>::infinity()), "halo: an infinite cutoff is refused");
        judge_.expect(refuses(of_more, cutoff_), "halo: a decomposition for other ranks is refused");
        // What one rank alone finds, all are told.
        judge_.expect(refuses(parts_, on_.rank() + 1 == on_.ranks() ? Real{-1} : cutoff_),
                      "halo: what one rank refuses is refused on all");
        examine_images(make(parts_, cutoff_));
    }

private:
    [[nodiscard]] halo_type make(const Parts& parts, Real cutoff) {
        if constexpr (tsubu::halo_pattern<tsubu::staged_pattern, Parts>)
            if (is_staged_) return tsubu::make_halo(store_, parts, cutoff, on_, tsubu::staged_pattern{});
        return tsubu::make_halo(store_, parts, cutoff, on_);
    }
    [[nodiscard]] const box_type& box() const { return parts_.whole(); }
    [[nodiscard]] std::int64_t id_of(std::size_t ghost) const {
        return store_[tsubu::id][store_.owned_count() + ghost];
    }

    void examine_images(const halo_type& halo) {
        std::vector<image_name> have;
        for (std::size_t k = 0; k < halo.ghost_count(); ++k)
            have.push_back(name_of(id_of(k), same_image(box(), halo.shift(k))));
        const all_images<box_type> images(box(), parts_.subdomain(on_.rank()), static_cast<double>(cutoff_),
                                          is_staged_);
        examine_names(have, images.of(all_, home_, on_.rank()), home_, on_.rank(), !is_staged_, judge_);
    }

    /// @param at  where all particles are
    [[nodiscard]] bool are_images(const halo_type& halo, const std::vector<position_type>& at) const {
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
                    is_image = is_image && std::abs(x[d] - wanted[d]) <= (is_staged_ || !is_domain ? rounding : 0);
            }
        }
        return is_image;
    }
    [[nodiscard]] bool are_turned(const halo_type& halo, Real scale) const {
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

    void examine_creation(const halo_type& halo) {
        judge_.expect(are_images(halo, all_), "halo: positions arrive moved into the image");
        judge_.expect(are_turned(halo, 1), "halo: vectors arrive turned into the image");
        bool has_lists = true;
        bool has_others = true;
        bool is_hidden = true;
        for (std::size_t k = 0; k < halo.ghost_count(); ++k) {
            const auto i = store_.owned_count() + k;
            has_lists = has_lists && carries_its_own(store_, i, id_of(k));
            has_others = has_others && store_[tally][i] == 1000.0 + static_cast<double>(id_of(k));
            is_hidden = is_hidden && store_[hidden][i] == 0 && store_[force][i] == real_position{};
        }
        judge_.expect(has_lists, "halo: lists and bonus values travel on creation");
        judge_.expect(has_others, "halo: other fields travel on creation");
        judge_.expect(is_hidden, "halo: what never travels is zero");
    }
    void examine_forward(halo_type& halo) {
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
        judge_.expect(are_images(halo, moved) && are_turned(halo, 2), "halo: forward brings several fields at once");
        halo.forward(store_, tally);
        bool has_tally = true;
        bool is_hidden = true;
        for (std::size_t k = 0; k < halo.ghost_count(); ++k) {
            has_tally = has_tally &&
                        store_[tally][store_.owned_count() + k] == -3.0 * static_cast<double>(id_of(k));
            is_hidden = is_hidden && store_[hidden][store_.owned_count() + k] == 0;
        }
        judge_.expect(has_tally, "halo: forward brings a field of another size");
        judge_.expect(is_hidden, "halo: forward brings no other fields");
        for (std::size_t i = 0; i < store_.owned_count(); ++i)
            store_[position][i] = all_[static_cast<std::size_t>(store_[tsubu::id][i])];
        halo.forward(store_, position, velocity);
        judge_.expect(are_images(halo, all_), "halo: forward can be called again, after fewer fields");
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
    void examine_reverse(halo_type& halo) {
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
        judge_.expect(is_sum, "halo: reverse adds what each ghost holds to its owner, once");
        judge_.expect(is_vector_sum, "halo: reverse turns vectors back");
        judge_.expect(is_least && is_greatest, "halo: reverse takes the least and the greatest");
        if (!is_staged_) {
            bool is_kept = true;
            for (std::size_t k = 0; k < halo.ghost_count(); ++k)
                is_kept = is_kept && store_[tally][store_.owned_count() + k] == static_cast<double>(weight(k));
            judge_.expect(is_kept, "halo: ghosts keep what they hold");
        }
    }
    /// Forward, then reverse: each owner has its value once more for each ghost, and the sum over all is conserved.
    void examine_both_ways(halo_type& halo) {
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
        judge_.expect(std::abs(sums[0] - sums[1]) <= 1e-13 * std::abs(sums[0]),
                      "halo: reverse conserves the sum over all");
    }
    /// Other work between the halves.
    void examine_halves(halo_type& halo) {
        const auto put = [&](double factor) {
            for (std::size_t i = 0; i < store_.owned_count(); ++i)
                store_[tally][i] = factor * static_cast<double>(store_[tsubu::id][i]);
        };
        put(5);
        halo.start_forward(store_, tally);
        if (!is_staged_) put(7);
        halo.finish_forward(store_, tally);
        bool is_of_start = true;
        for (std::size_t k = 0; k < halo.ghost_count(); ++k)
            is_of_start = is_of_start && store_[tally][store_.owned_count() + k] == 5 * static_cast<double>(id_of(k));
        judge_.expect(is_of_start, "halo: the first half of forward takes the values, the second half brings them");
        for (std::size_t k = 0; k < halo.ghost_count(); ++k) store_[tally][store_.owned_count() + k] = 1;
        put(0);
        halo.start_reverse(store_, tally);
        for (std::size_t i = 0; i < store_.owned_count(); ++i) store_[tally][i] += 2;  // before others add to it
        halo.finish_reverse(store_, tally);
        double sums[] = {0, static_cast<double>(halo.ghost_count() + 2 * store_.owned_count())};
        for (std::size_t i = 0; i < store_.owned_count(); ++i) sums[0] += store_[tally][i];
        on_.reduce(std::span<double>(sums), tsubu::reduction::sum);
        judge_.expect(sums[0] == sums[1], "halo: owners may be added to between the halves of reverse");
    }
    void examine_messages(const halo_type& halo) {
        std::uint64_t sums[] = {halo.sent_count(), halo.ghost_count(), halo.sent_messages(), halo.received_messages()};
        on_.reduce(std::span<std::uint64_t>(sums), tsubu::reduction::sum);
        judge_.expect(sums[0] == sums[1], "halo: as many are sent as there are ghosts");
        judge_.expect(sums[2] == sums[3], "halo: as many messages are sent as come");
        if (!is_staged_) {
            std::vector<bool> is_met(on_.ranks(), false);
            for (std::size_t k = 0; k < halo.ghost_count(); ++k)
                is_met[home_[static_cast<std::size_t>(id_of(k))]] = true;
            is_met[on_.rank()] = false;
            const auto met = static_cast<std::size_t>(std::count(is_met.begin(), is_met.end(), true));
            judge_.expect(halo.received_messages() == met,
                          "halo: one message comes from each other rank that owns ghosts of this one");
        }
    }
    /// After particles have come or gone.
    void examine_stale(halo_type& halo) {
        const auto refuses = [&](auto&& use) {
            try {
                use();
            } catch (const tsubu::input_error&) {
                return true;
            }
            return false;
        };
        store_.add_ghosts(1);
        judge_.expect(refuses([&] { halo.forward(store_, tally); }) && refuses([&] { halo.reverse(store_, tally); }),
                      "halo: a store with other ghosts is refused");
        store_.clear_ghosts();
        store_.push_back();
        judge_.expect(refuses([&] { halo.forward(store_, tally); }) &&
                          refuses([&] { halo.finish_forward(store_, tally); }),
                      "halo: a store with other particles is refused");
        store_.swap_remove(store_.owned_count() - 1);
    }

    const Parts& parts_;
    Transport& on_;
    bool is_staged_;
    Real cutoff_;
    std::uint64_t seed_;
    halo_verdict judge_;
    store_type store_;
    std::vector<position_type> all_;
    std::vector<tsubu::rank_t> home_;
};

/// As many particles as leave some thousand images.
[[nodiscard]] inline std::size_t count_for(double cutoff) { return cutoff < 0.2 ? 90 : cutoff < 1 ? 50 : 14; }

template <class Layout = tsubu::soa, class Parts, class Transport>
void ghosts_are_images(const Parts& parts, Transport& on, passed how, double cutoff, verdict& seen) {
    ghosts_of<Parts, Transport, Layout> all(parts, on, how, cutoff, 11 + on.ranks(), count_for(cutoff), seen);
    all.examine();
}

}  // namespace comm_laws

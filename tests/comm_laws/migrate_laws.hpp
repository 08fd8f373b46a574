// SPDX-License-Identifier: MIT
/// @file
/// What migrate promises, as checks over any transport: every rank computes where all particles have to be, and looks.
#pragma once

#include <tsubu/comm/migrate.hpp>

#include "comm_laws/known_particles.hpp"
#include "support/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace comm_laws {

/// Who begins with the particles.
enum class at_first { everyone, the_last_rank, owners };

/// All particles of all ranks, moved and wrapped as they ought to be, and the store of this rank beside them.
template <class Parts, class Transport, class Layout = tsubu::soa>
class migrations {
    static constexpr auto D = Parts::dimension;
    using Scalar = typename Parts::scalar_type;
    using Real = typename Parts::real_type;
    using position_type = typename Parts::position_type;
    static constexpr auto position = tsubu::position<D, Scalar>;
    static constexpr auto velocity = tsubu::velocity<D, Real>;

    struct known {
        position_type at;
        tsubu::image_shift<D> periods{};
        tsubu::vec<D, Real> velocity{};
        tsubu::rank_t home = 0;
    };

public:
    using store_type = known_store<Parts, Layout>;

    migrations(const Parts& parts, Transport& on, std::uint64_t seed, std::size_t count, at_first first, verdict& seen)
        : parts_(parts), on_(on), seed_(seed), seen_(seen) {
        const auto points = points_in(parts.whole(), count, seed);
        for (std::size_t t = 0; t < count; ++t) {
            known one{points[t], {}, velocity_of<D, Real>(static_cast<std::int64_t>(t)), 0};
            const auto ranks = on.ranks();
            one.home = first == at_first::owners     ? parts.owner(one.at)
                       : first == at_first::everyone ? static_cast<tsubu::rank_t>(t % ranks)
                                                     : static_cast<tsubu::rank_t>(ranks - 1);
            all_.push_back(one);
            if (one.home == on.rank()) add_known<Parts>(store_, static_cast<std::int64_t>(t), one.at);
        }
    }

    [[nodiscard]] store_type& store() noexcept { return store_; }

    /// Some particles move, a little or far; migrate; everything is looked at.
    void step(std::size_t number, std::size_t looks_every = 1) {
        number_ = number;
        tsubu::random_stream random(tsubu::splitmix64(seed_) + number);
        const bool nobody = number % 7 == 3;
        const bool all = number % 5 == 0;
        std::size_t sent = 0;
        std::size_t received = 0;
        std::vector<position_type> moved(all_.size());
        for (std::size_t t = 0; t < all_.size(); ++t) {
            auto& one = all_[t];
            moved[t] = nobody ? one.at : elsewhere(one.at, all, random);
            const auto fresh = parts_.whole().wrap(moved[t]);
            one.at = fresh.position;
            for (std::size_t k = 0; k < D; ++k) one.periods[k] += fresh.shift[k];
            one.velocity = turned(parts_.whole(), one.velocity, back(fresh.shift));
            const auto from = one.home;
            one.home = parts_.owner(one.at);
            sent += from == on_.rank() && one.home != from ? 1U : 0U;
            received += one.home == on_.rank() && one.home != from ? 1U : 0U;
        }
        for (std::size_t i = 0; i < store_.owned_count(); ++i)
            store_[position][i] = moved[static_cast<std::size_t>(store_[tsubu::id][i])];
        if (number % 3 == 1) store_.add_ghosts(2);
        const auto done = tsubu::migrate(store_, parts_, on_);
        expect(done.sent == sent && done.received == received && done.lost == 0,
               "migrate: tells how many were sent and received");
        if (number % looks_every == 0) look();
    }
    /// Who is here, and as it ought to be.
    void look() {
        expect(store_.ghost_count() == 0, "migrate: ghosts are cleared");
        const auto mine = parts_.subdomain(on_.rank());
        const auto here = static_cast<std::size_t>(std::count_if(
            all_.begin(), all_.end(), [&](const known& one) { return one.home == on_.rank(); }));
        std::set<std::int64_t> seen;
        bool is_owned = true;
        bool is_at = true;
        bool has_periods = true;
        bool has_velocity = true;
        bool has_lists = true;
        bool has_others = true;
        for (std::size_t i = 0; i < store_.owned_count(); ++i) {
            const auto t = store_[tsubu::id][i];
            if (t < 0 || static_cast<std::size_t>(t) >= all_.size()) {
                is_owned = false;
                continue;
            }
            const auto& one = all_[static_cast<std::size_t>(t)];
            seen.insert(t);
            is_owned = is_owned && one.home == on_.rank() && mine.owns(store_[position][i]);
            is_at = is_at && store_[position][i] == one.at;
            has_periods = has_periods && store_[tsubu::image<D>][i] == one.periods;
            has_velocity = has_velocity && store_[velocity][i] == one.velocity;
            has_lists = has_lists && carries_its_own(store_, i, t);
            has_others = has_others && store_[hidden][i] == 3.5 + static_cast<double>(t) &&
                         store_[tally][i] == 1000.0 + static_cast<double>(t);
        }
        expect(is_owned, "migrate: every particle is on the rank whose subdomain owns it");
        expect(seen.size() == store_.owned_count(), "migrate: no particle is doubled");
        expect(seen.size() == here, "migrate: no particle is lost");
        expect(is_at, "migrate: positions arrive wrapped, bit for bit");
        expect(has_periods, "migrate: image counts the periods");
        expect(has_velocity, "migrate: vectors turn with the wrap, and only then");
        expect(has_lists, "migrate: lists and bonus values go along");
        expect(has_others, "migrate: fields that ghosts do not get go along");
        std::uint64_t sums[] = {store_.owned_count(), 0};
        for (const auto t : store_.owned()[tsubu::id]) sums[1] += static_cast<std::uint64_t>(t);
        on_.reduce(std::span<std::uint64_t>(sums), tsubu::reduction::sum);
        expect(sums[0] == all_.size() && sums[1] == all_.size() * (all_.size() - 1) / 2,
               "migrate: the sum of particles and that of their ids stay");
    }

    /// One coordinate on one rank is not a number.
    void refuse_nan()
        requires(!tsubu::is_lattice<Scalar>)
    {
        const auto culprit = all_[all_.size() / 2].home;
        const bool is_here = on_.rank() == culprit;
        const auto i = is_here ? index_of(static_cast<std::int64_t>(all_.size() / 2)) : 0;
        if (is_here) store_[position][i][D - 1] = std::numeric_limits<Scalar>::quiet_NaN();
        const auto text = refusal([&] { tsubu::migrate(store_, parts_, on_); });
        expect(is_here ? text.find("particle " + std::to_string(all_.size() / 2)) != text.npos
                       : text.find("rank " + std::to_string(culprit) + " refused") != text.npos,
               "migrate: all ranks refuse a NaN, and the message names the particle, or its rank");
        if (is_here) store_[position][i] = all_[all_.size() / 2].at;
        look();
    }
    void refuse_other_ranks(const Parts& of_more) {
        const auto text = refusal([&] { tsubu::migrate(store_, of_more, on_); });
        expect(text.find("a decomposition for " + std::to_string(of_more.ranks()) + " ranks on " +
                         std::to_string(on_.ranks())) != text.npos,
               "migrate: a decomposition for other ranks is refused, with both numbers");
        look();
    }

    /// Every fifth particle goes far beyond a face that is not periodic. @param axis  of the cell
    void lose(std::size_t axis)
        requires(!tsubu::is_lattice<Scalar>)
    {
        gone_.clear();
        for (std::size_t t = 0; t < all_.size(); t += 5) {
            auto at = parts_.whole().to_cell(all_[t].at);
            const auto& along = parts_.whole().cell().along(axis);
            if (t % 2 == 0)
                at[axis] = along.hi() + 2 * along.length();
            else
                at[axis] = has_no_lower_face(axis) ? 3 * along.hi() : along.lo() - along.length();
            gone_.push_back(t);
            all_[t].at = parts_.whole().from_cell(at);
        }
        put_positions();

        const auto text = refusal([&] { tsubu::migrate(store_, parts_, on_); });
        const bool is_here = std::any_of(gone_.begin(), gone_.end(),
                                         [&](std::size_t t) { return all_[t].home == on_.rank(); });
        bool names = text.find("have left the box") != text.npos;
        std::size_t named = 0;
        for (const auto t : store_.owned()[tsubu::id])
            if (t % 5 == 0 && named++ < 8)
                names = names && text.find(std::to_string(t) + " at (") != text.npos;
        expect(is_here ? names : text.find("refused the input") != text.npos,
               "migrate: particles that have left are refused on all ranks, and named where they are");
        expect_nobody_moved();

        // The same again, collected.
        using fewer = tsubu::fields<tsubu::id, contacts, tsubu::position<D, Scalar>, tsubu::mass>;
        tsubu::particle_store<fewer> outside;
        outside.push_back(tsubu::id = 12345);
        auto copy = store_;
        std::size_t here = 0;
        for (const auto t : gone_) here += all_[t].home == on_.rank() ? 1U : 0U;
        const auto done = tsubu::migrate(copy, parts_, on_, tsubu::collect_lost(outside));
        bool is_whole = done.lost == here && outside.owned_count() == here + 1;
        for (std::size_t i = 1; i < outside.owned_count(); ++i) {
            const auto t = outside[tsubu::id][i];
            const auto list = outside[contacts][i].span();
            is_whole = is_whole && t % 5 == 0 && outside[position][i] == all_[static_cast<std::size_t>(t)].at &&
                       std::vector<contact>(list.begin(), list.end()) == contacts_of(t);
        }
        expect(is_whole, "migrate: collected particles lie in the other store, as they were");
        bool is_gone = true;
        for (const auto t : copy.owned()[tsubu::id]) is_gone = is_gone && t % 5 != 0;
        expect(is_gone && copy.owned_count() + here == store_.owned_count(),
               "migrate: collected particles are in the store no more, and all others are");

        // And clamped.
        const auto clamped = tsubu::migrate(store_, parts_, on_, tsubu::clamp_lost{});
        expect(clamped.lost == here, "migrate: tells how many were clamped");
        const auto mine = parts_.subdomain(on_.rank());
        bool is_inside = true;
        bool is_nearest = true;
        for (std::size_t i = 0; i < store_.owned_count(); ++i) {
            const auto x = store_[position][i];
            const auto t = static_cast<std::size_t>(store_[tsubu::id][i]);
            is_inside = is_inside && parts_.whole().contains(x) && mine.owns(x);
            if (t % 5 != 0) continue;
            auto at = parts_.whole().to_cell(all_[t].at);
            const auto& along = parts_.whole().cell().along(axis);
            at[axis] = t % 2 == 0 || has_no_lower_face(axis) ? along.hi() : along.lo();
            const auto wanted = parts_.whole().from_cell(at);
            const auto off = parts_.whole().minimum_image(x, wanted);
            for (const auto d : off)
                is_nearest = is_nearest && std::abs(d) < 64 * static_cast<double>(std::numeric_limits<Real>::epsilon());
        }
        expect(is_inside, "migrate: clamped particles are in the box, on the rank that owns them");
        expect(is_nearest, "migrate: clamped particles lie on the face that they have left by");
        std::uint64_t sums[] = {store_.owned_count(), 0};
        for (const auto t : store_.owned()[tsubu::id]) sums[1] += static_cast<std::uint64_t>(t);
        on_.reduce(std::span<std::uint64_t>(sums), tsubu::reduction::sum);
        expect(sums[0] == all_.size() && sums[1] == all_.size() * (all_.size() - 1) / 2,
               "migrate: the sum of particles and that of their ids stay when some are clamped");
        const auto again = tsubu::migrate(store_, parts_, on_);
        expect(again.sent == 0 && again.lost == 0, "migrate: what was clamped stays where it is");
    }

private:
    /// The distance from the axis of a wedge: nothing is below 0.
    [[nodiscard]] static bool has_no_lower_face(std::size_t axis) {
        return axis == 1 && tsubu::cyclic_box<typename Parts::box_type>;
    }
    template <class Work>
    std::string refusal(Work&& work) {
        try {
            work();
        } catch (const tsubu::input_error& thrown) {
            return thrown.what();
        }
        return "nothing was thrown";
    }
    void put_positions() {
        for (std::size_t i = 0; i < store_.owned_count(); ++i)
            store_[position][i] = all_[static_cast<std::size_t>(store_[tsubu::id][i])].at;
    }
    void expect_nobody_moved() {
        std::size_t here = 0;
        for (const auto& one : all_) here += one.home == on_.rank() ? 1U : 0U;
        bool is_same = store_.owned_count() == here;
        for (std::size_t i = 0; i < store_.owned_count(); ++i) {
            const auto t = store_[tsubu::id][i];
            const auto& one = all_[static_cast<std::size_t>(t)];
            is_same = is_same && one.home == on_.rank() && store_[position][i] == one.at;
            is_same = is_same && carries_its_own(store_, i, t);
        }
        expect(is_same, "migrate: after a refusal every particle is where it was");
    }
    [[nodiscard]] std::size_t index_of(std::int64_t t) const {
        for (std::size_t i = 0; i < store_.owned_count(); ++i)
            if (store_[tsubu::id][i] == t) return i;
        return store_.owned_count();
    }
    /// A point that is in the box when it is wrapped: near, several boxes away, or on a face between ranks.
    [[nodiscard]] position_type elsewhere(const position_type& x, bool all, tsubu::random_stream& random) const {
        const auto kind = all ? 3 + random.below(5) : random.below(8);
        auto y = x;
        if constexpr (tsubu::is_lattice<Scalar>) {
            using Int = decltype(y[0].value);
            const int narrower = kind < 3 ? 8 * static_cast<int>(sizeof(Int)) : kind < 6 ? 4 : 0;
            for (auto& coordinate : y)
                if (narrower < 8 * static_cast<int>(sizeof(Int)))
                    coordinate = coordinate + static_cast<Int>(static_cast<Int>(random()) >> narrower);
        } else {
            const auto& where = parts_.whole();
            if (kind < 3) return x;
            if (kind == 7) {  // a corner of a rank
                const auto lo = parts_.subdomain(random.below(parts_.ranks())).lo();
                y = where.from_cell(lo);
            } else {
                const double scale = kind == 6 ? 9 : 0.2;
                for (auto& coordinate : y) coordinate += static_cast<Scalar>((random.unit() - 0.5) * scale);
            }
            if (!where.contains(where.wrap(y).position)) return x;
        }
        return y;
    }
    void expect(bool kept, const char* law) {
        if (kept) return seen_(true, law);
        seen_(false, law + ("; rank " + std::to_string(on_.rank()) + " of " + std::to_string(on_.ranks()) + ", step " +
                            std::to_string(number_) + ", seed " + std::to_string(seed_)));
    }

    const Parts& parts_;
    Transport& on_;
    std::uint64_t seed_;
    verdict& seen_;
    store_type store_;
    std::vector<known> all_;
    std::vector<std::size_t> gone_;
    std::size_t number_ = 0;
};

/// Random motion over some steps; then one particle is nowhere.
template <class Layout = tsubu::soa, class Parts, class Transport>
void migrate_keeps_all(const Parts& parts, Transport& on, std::uint64_t seed, std::size_t count, std::size_t steps,
                       verdict& seen, at_first first = at_first::everyone) {
    migrations<Parts, Transport, Layout> all(parts, on, seed, count, first, seen);
    for (std::size_t k = 0; k < steps; ++k) all.step(k);
    if constexpr (!tsubu::is_lattice<typename Parts::scalar_type>) {
        all.refuse_nan();
        all.step(steps);
    }
}
/// Particles leave through a face that is not periodic.
template <class Layout = tsubu::soa, class Parts, class Transport>
void migrate_settles_the_lost(const Parts& parts, Transport& on, std::uint64_t seed, std::size_t axis, verdict& seen) {
    migrations<Parts, Transport, Layout> all(parts, on, seed, 60, at_first::everyone, seen);
    all.step(0);
    all.lose(axis);
}

}  // namespace comm_laws

// SPDX-License-Identifier: MIT
/// @file
/// Migration and ghosts by hand, for parts that stand in a row along x, which is periodic.
#pragma once

#include <tsubu/comm/detail/include_mpi.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <array>    // std::array
#include <cstddef>  // std::size_t
#include <cstdint>  // std::int64_t, std::uint64_t
#include <span>     // std::span
#include <vector>   // std::vector

namespace bench {

/// Where a rank stands in the row.
struct row_place {
    int rank, next, before;
    double lo, hi;  ///< its part
    double length;  ///< of all
};

/// What a program would have that moves these fields along the row, and nothing else: who leaves shows in
/// one coordinate, and goes to a part next to this one; those that come take the places of those that have gone.
class hand_migration {
public:
    template <class Store>
    hand_migration(const row_place& here, const Store& g) : here_(here) {
        const auto copy = [](auto& to, auto from) { to.assign(from.begin(), from.end()); };
        copy(t_, g[tsubu::id].span());
        copy(x_, g[tsubu::position<3>].span());
        copy(v_, g[tsubu::velocity<3>].span());
        copy(m_, g[tsubu::mass].span());
    }
    [[nodiscard]] std::span<const std::int64_t> ids() const { return t_; }
    [[nodiscard]] std::span<tsubu::vec<3>> positions() { return x_; }
    [[nodiscard]] std::span<const tsubu::vec<3>> velocities() const { return v_; }

    void operator()() {
        places_.clear();
        for (auto& one : out_) one.clear();
        const bool is_one_way = here_.next == here_.before;  // a message of all
        for (std::size_t i = 0; i < x_.size(); ++i) {
            if (x_[i][0] >= here_.lo && x_[i][0] < here_.hi) continue;
            places_.push_back(i);
            auto x = x_[i];
            auto& out = out_[x[0] < here_.lo && !is_one_way ? 1 : 0];
            x[0] += x[0] < 0 ? here_.length : x[0] >= here_.length ? -here_.length : 0;
            out.push_back({t_[i], x, v_[i], m_[i]});
        }
        came_.clear();
        swap_with(here_.next, here_.before, out_[0]);
        if (!is_one_way) swap_with(here_.before, here_.next, out_[1]);
        std::size_t k = 0;
        for (; k < came_.size() && k < places_.size(); ++k) put(came_[k], places_[k]);
        for (; k < came_.size(); ++k) {
            resize(x_.size() + 1);
            put(came_[k], x_.size() - 1);
        }
        for (auto n = places_.size(); n > k; --n) {
            const auto last = x_.size() - 1;
            put({t_[last], x_[last], v_[last], m_[last]}, places_[n - 1]);
            resize(last);
        }
    }

private:
    struct record {
        std::int64_t t;
        tsubu::vec<3> x, v;
        double m;
    };
    void put(const record& one, std::size_t i) { t_[i] = one.t, x_[i] = one.x, v_[i] = one.v, m_[i] = one.m; }
    void resize(std::size_t n) { t_.resize(n), x_.resize(n), v_.resize(n), m_.resize(n); }
    void swap_with(int to, int from, const std::vector<record>& out) {
        const std::uint64_t sends = out.size();
        std::uint64_t gets = 0;
        MPI_Sendrecv(&sends, 1, MPI_UINT64_T, to, 4, &gets, 1, MPI_UINT64_T, from, 4, MPI_COMM_WORLD,
                     MPI_STATUS_IGNORE);
        const auto before = came_.size();
        came_.resize(before + static_cast<std::size_t>(gets));
        MPI_Sendrecv(out.data(), static_cast<int>(sends * sizeof(record)), MPI_BYTE, to, 5, came_.data() + before,
                     static_cast<int>(gets * sizeof(record)), MPI_BYTE, from, 5, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    }

    row_place here_;
    std::vector<std::int64_t> t_;
    std::vector<tsubu::vec<3>> x_, v_;
    std::vector<double> m_;
    std::vector<std::size_t> places_;
    std::array<std::vector<record>, 2> out_;
    std::vector<record> came_;
};

/// What a program would have that exchanges positions and forces along the row, and nothing else: arrays of its
/// own, buffers that are there already, the shift added as particles are packed, ghosts received where they are to lie.
class hand_halo {
public:
    template <class Store>
    hand_halo(const row_place& here, const Store& g, double cutoff) {
        const auto x = g[tsubu::position<3>].span().first(g.owned_count());
        x_.assign(x.begin(), x.end());
        for (std::size_t i = 0; i < x.size(); ++i)
            if (x[i][0] >= here.hi - cutoff) go(i, here.next <= here.rank ? -here.length : 0);
        const auto up = chosen_.size();
        for (std::size_t i = 0; i < x.size(); ++i)
            if (x[i][0] <= here.lo + cutoff) go(i, here.before >= here.rank ? here.length : 0);
        const auto all = chosen_.size();
        if (here.next == here.before)  // one message of all
            neighbours_ = {{here.next, 0, all, x.size(), 0}};
        else
            neighbours_ = {{here.next, 0, up, x.size(), 0}, {here.before, up, all - up, x.size(), 0}};
        for (auto& one : neighbours_) {
            const std::uint64_t sends = one.sends;
            std::uint64_t gets = 0;
            MPI_Sendrecv(&sends, 1, MPI_UINT64_T, one.rank, 2, &gets, 1, MPI_UINT64_T, one.rank, 2, MPI_COMM_WORLD,
                         MPI_STATUS_IGNORE);
            one.first_ghost = x_.size();
            one.gets = static_cast<std::size_t>(gets);
            x_.resize(x_.size() + one.gets);
        }
        force_.resize(x_.size());
        pieces_.resize(all);
    }
    [[nodiscard]] const std::vector<tsubu::vec<3>>& positions() const { return x_; }
    [[nodiscard]] std::vector<tsubu::vec<3>>& forces() { return force_; }
    /// Particles that go up, down, come from below, from above; all in the first where both are one rank.
    [[nodiscard]] std::array<std::size_t, 4> counts() const {
        const auto& up = neighbours_.front();
        if (neighbours_.size() == 1) return {up.sends, 0, up.gets, 0};
        const auto& down = neighbours_.back();
        return {up.sends, down.sends, down.gets, up.gets};
    }

    void forward() {
        for (const auto& one : neighbours_) receive(x_.data() + one.first_ghost, one.gets, one.rank);
        for (std::size_t k = 0; k < chosen_.size(); ++k) {
            const auto& x = x_[static_cast<std::size_t>(chosen_[k])];
            pieces_[k] = {x[0] + moved_[k], x[1], x[2]};
        }
        for (const auto& one : neighbours_) send(pieces_.data() + one.first_sent, one.sends, one.rank);
        finish();
    }
    void reverse() {
        for (const auto& one : neighbours_) receive(pieces_.data() + one.first_sent, one.sends, one.rank);
        for (const auto& one : neighbours_) send(force_.data() + one.first_ghost, one.gets, one.rank);
        finish();
        for (std::size_t k = 0; k < chosen_.size(); ++k) {
            auto& f = force_[static_cast<std::size_t>(chosen_[k])];
            const auto& more = pieces_[k];
            f = {f[0] + more[0], f[1] + more[1], f[2] + more[2]};
        }
    }

private:
    struct neighbour {
        int rank;
        std::size_t first_sent, sends, first_ghost, gets;
    };
    void go(std::size_t i, double moved) {
        chosen_.push_back(static_cast<tsubu::index_t>(i));
        moved_.push_back(moved);
    }
    void receive(tsubu::vec<3>* to, std::size_t count, int from) {
        MPI_Irecv(to, static_cast<int>(3 * count), MPI_DOUBLE, from, 3, MPI_COMM_WORLD, &requests_[active_++]);
    }
    void send(const tsubu::vec<3>* from, std::size_t count, int to) {
        MPI_Isend(from, static_cast<int>(3 * count), MPI_DOUBLE, to, 3, MPI_COMM_WORLD, &requests_[active_++]);
    }
    void finish() {
        MPI_Waitall(static_cast<int>(active_), requests_.data(), MPI_STATUSES_IGNORE);
        active_ = 0;
    }

    std::vector<tsubu::vec<3>> x_, force_;
    std::vector<tsubu::index_t> chosen_;
    std::vector<double> moved_;
    std::vector<tsubu::vec<3>> pieces_;
    std::vector<neighbour> neighbours_;
    std::array<MPI_Request, 4> requests_{};
    std::size_t active_ = 0;
};

}  // namespace bench

// SPDX-License-Identifier: MIT
/// @file
/// Decompositions that break one law each, as real ones do: the conformance suite must catch every one.
#pragma once

#include <tsubu/domain/brick_decomposition.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace tsubu::testing::broken {

/// What the twins share: everything right. Bricks 3 x 2 in a box that is periodic along x.
class sound_bricks {
public:
    using box_type = domain<2>;
    using scalar_type = double;
    using real_type = double;
    using position_type = vec<2>;
    static constexpr std::size_t dimension = 2;
    static constexpr double lo_x = -0.1;
    static constexpr double length = 0.7;

    [[nodiscard]] std::size_t ranks() const noexcept { return bricks_.ranks(); }
    [[nodiscard]] rank_t owner(const position_type& x) const noexcept { return bricks_.owner(x); }
    void owner(const points<2>& x, std::span<rank_t> owners) const { bricks_.owner(x, owners); }
    [[nodiscard]] const domain<2>& whole() const noexcept { return bricks_.whole(); }
    [[nodiscard]] tsubu::subdomain<2> subdomain(std::size_t rank) const { return bricks_.subdomain(rank); }
    [[nodiscard]] std::vector<neighbor_rank<2>> neighbors(std::size_t rank, double cutoff) const {
        return bricks_.neighbors(rank, cutoff);
    }

protected:
    using box = std::array<interval<double>, 2>;
    /// The subdomain of a rank after `change(owned, extended, place)`.
    template <class Change>
    [[nodiscard]] tsubu::subdomain<2> changed(std::size_t rank, Change&& change) const {
        const auto right = bricks_.subdomain(rank);
        const auto at = bricks_.place(rank);
        box owned{bricks_.along(0).owned(at[0]), bricks_.along(1).owned(at[1])};
        box extended{bricks_.along(0).owned_extended(at[0]), bricks_.along(1).owned_extended(at[1])};
        change(owned, extended, at);
        return {owned, extended, right.lo(), right.hi()};
    }
    using place = std::array<std::size_t, 2>;

    brick_decomposition<2> bricks_{{{lo_x, 0}, {lo_x + length, 1}, {.periodic = {true, false}}}, place{3, 2}};
};

// --- law 1 ----------------------------------------------------------------------------------------------------------

/// lo <= x <= hi everywhere: two ranks own what lies on a cut.
struct closed_upper_faces : sound_bricks {
    static constexpr const char* breaks = "law 1";
    [[nodiscard]] tsubu::subdomain<2> subdomain(std::size_t rank) const {
        return changed(rank, [](box& owned, box&, const place&) {
            owned[0].last = std::nextafter(owned[0].last, std::numeric_limits<double>::infinity());
        });
    }
};
/// Faces computed by each rank from its own side: one number between two of them is nobody's.
struct gap_of_one_place : sound_bricks {
    static constexpr const char* breaks = "law 1";
    [[nodiscard]] tsubu::subdomain<2> subdomain(std::size_t rank) const {
        return changed(rank, [](box& owned, box& extended, const place& at) {
            if (at[0] != 1) return;
            owned[0].first = std::nextafter(owned[0].first, 1.0);
            extended[0].first = owned[0].first;
        });
    }
};
/// Half-open, as between ranks, also where a closed box ends.
struct open_top : sound_bricks {
    static constexpr const char* breaks = "law 1";
    [[nodiscard]] tsubu::subdomain<2> subdomain(std::size_t rank) const {
        return changed(rank, [](box& owned, box&, const place& at) {
            if (at[1] == 1) owned[1].last = std::nextafter(1.0, 0.0);
        });
    }
};
/// A face moved out by 1e-8.
struct padded_face : sound_bricks {
    static constexpr const char* breaks = "law 1";
    [[nodiscard]] tsubu::subdomain<2> subdomain(std::size_t rank) const {
        return changed(rank, [](box& owned, box&, const place& at) {
            if (at[0] == 0) owned[0].first -= 1e-8;
        });
    }
};
/// The lowest rank takes x <= hi of what lies outside.
struct two_extended_owners : sound_bricks {
    static constexpr const char* breaks = "law 1";
    [[nodiscard]] tsubu::subdomain<2> subdomain(std::size_t rank) const {
        return changed(rank, [&](box&, box& extended, const place& at) {
            if (at[0] == 0) extended[0].last = bricks_.along(0).begin(1);
        });
    }
};
/// What lies below the box is lost.
struct low_side_is_lost : sound_bricks {
    static constexpr const char* breaks = "law 1";
    [[nodiscard]] tsubu::subdomain<2> subdomain(std::size_t rank) const {
        return changed(rank, [](box& owned, box& extended, const place& at) {
            if (at[0] == 0) extended[0].first = owned[0].first;
        });
    }
};

/// Its faces are those of the box.
struct faces_of_all : sound_bricks {
    static constexpr const char* breaks = "law 1";
    [[nodiscard]] tsubu::subdomain<2> subdomain(std::size_t rank) const {
        const auto at = bricks_.place(rank);
        return {box{bricks_.along(0).owned(at[0]), bricks_.along(1).owned(at[1])},
                box{bricks_.along(0).owned_extended(at[0]), bricks_.along(1).owned_extended(at[1])},
                {lo_x, 0},
                {lo_x + length, 1}};
    }
};

// --- law 2 ----------------------------------------------------------------------------------------------------------

/// The formula alone, without a look at the cuts.
struct owner_by_formula : sound_bricks {
    static constexpr const char* breaks = "law 2";
    void owner(const points<2>& x, std::span<rank_t> owners) const {
        for (std::size_t i = 0; i < x.size(); ++i) owners[i] = owner(x[i]);
    }
    [[nodiscard]] rank_t owner(const position_type& x) const noexcept {
        const auto part = [](double share, double parts) {
            return static_cast<rank_t>(std::clamp(std::floor(share * parts), 0.0, parts - 1));
        };
        return part((x[0] - lo_x) / length, 3) * 2 + part(x[1], 2);
    }
};
/// Numbered along the other axis first.
struct ranks_swapped : sound_bricks {
    static constexpr const char* breaks = "law 2";
    void owner(const points<2>& x, std::span<rank_t> owners) const {
        for (std::size_t i = 0; i < x.size(); ++i) owners[i] = owner(x[i]);
    }
    [[nodiscard]] rank_t owner(const position_type& x) const noexcept {
        const auto at = bricks_.place(bricks_.owner(x));
        return static_cast<rank_t>(at[1] * 3 + at[0]);
    }
};
/// Points beyond the periodic face go to the rank of their image, points there are extended by another.
struct owner_of_image : sound_bricks {
    static constexpr const char* breaks = "law 2";
    void owner(const points<2>& x, std::span<rank_t> owners) const {
        for (std::size_t i = 0; i < x.size(); ++i) owners[i] = owner(x[i]);
    }
    [[nodiscard]] rank_t owner(const position_type& x) const noexcept {
        return bricks_.owner({x[0] >= lo_x + length ? x[0] - length : x[0], x[1]});
    }
};

/// The batch guesses, and does not look at the cuts.
struct batch_by_formula : sound_bricks {
    static constexpr const char* breaks = "law 2";
    [[nodiscard]] rank_t owner(const position_type& x) const noexcept { return sound_bricks::owner(x); }
    void owner(const points<2>& x, std::span<rank_t> owners) const { owner_by_formula{}.owner(x, owners); }
};

/// Rows are read as if they were columns of one.
struct rows_are_forgotten : sound_bricks {
    static constexpr const char* breaks = "law 2";
    struct part : tsubu::subdomain<2> {
        using tsubu::subdomain<2>::owns;
        void owns(const points<2>& x, std::span<unsigned char> mask) const {
            tsubu::subdomain<2>::owns(x, mask);
            if (!x.are_columns() && !mask.empty()) mask.back() = mask.back() == 0 ? 1 : 0;
        }
    };
    [[nodiscard]] part subdomain(std::size_t rank) const { return {bricks_.subdomain(rank)}; }
};

// --- law 3 ----------------------------------------------------------------------------------------------------------

/// Neighbours that touch at a corner only are left out.
struct lost_corner : sound_bricks {
    static constexpr const char* breaks = "law 3";
    [[nodiscard]] std::vector<neighbor_rank<2>> neighbors(std::size_t rank, double cutoff) const {
        auto found = bricks_.neighbors(rank, cutoff);
        const auto mine = bricks_.place(rank);
        std::erase_if(found, [&](const neighbor_rank<2>& other) {
            const auto at = bricks_.place(other.rank);
            return at[0] != mine[0] && at[1] != mine[1];
        });
        return found;
    }
};
/// One hop along each axis, however far the cutoff reaches.
struct nearest_only : sound_bricks {
    static constexpr const char* breaks = "law 3";
    [[nodiscard]] std::vector<neighbor_rank<2>> neighbors(std::size_t rank, double cutoff) const {
        return bricks_.neighbors(rank, std::min(cutoff, 0.1));
    }
};
/// No image of itself, though the cutoff reaches around the box.
struct no_self_image : sound_bricks {
    static constexpr const char* breaks = "law 3";
    [[nodiscard]] std::vector<neighbor_rank<2>> neighbors(std::size_t rank, double cutoff) const {
        auto found = bricks_.neighbors(rank, cutoff);
        std::erase_if(found, [&](const neighbor_rank<2>& other) { return other.rank == rank; });
        return found;
    }
};
/// Itself, without a shift.
struct neighbor_of_itself : sound_bricks {
    static constexpr const char* breaks = "law 3";
    [[nodiscard]] std::vector<neighbor_rank<2>> neighbors(std::size_t rank, double cutoff) const {
        auto found = bricks_.neighbors(rank, cutoff);
        found.push_back({static_cast<rank_t>(rank), {0, 0}});
        std::sort(found.begin(), found.end());
        return found;
    }
};
/// A neighbour that is met on both sides is named twice.
struct named_twice : sound_bricks {
    static constexpr const char* breaks = "law 3";
    [[nodiscard]] std::vector<neighbor_rank<2>> neighbors(std::size_t rank, double cutoff) const {
        auto found = bricks_.neighbors(rank, cutoff);
        if (!found.empty()) found.push_back(found.back());
        return found;
    }
};
/// A square of the cutoff, instead of a disk: corners too far away.
struct too_many : sound_bricks {
    static constexpr const char* breaks = "law 3";
    [[nodiscard]] std::vector<neighbor_rank<2>> neighbors(std::size_t rank, double cutoff) const {
        return bricks_.neighbors(rank, cutoff * 1.5);
    }
};

// --- law 4 ----------------------------------------------------------------------------------------------------------

/// Half a list: only whom a rank sends to.
struct one_sided : sound_bricks {
    static constexpr const char* breaks = "law 4";
    [[nodiscard]] std::vector<neighbor_rank<2>> neighbors(std::size_t rank, double cutoff) const {
        auto found = bricks_.neighbors(rank, cutoff);
        std::erase_if(found, [&](const neighbor_rank<2>& other) { return other.rank < rank; });
        return found;
    }
};
/// The shift of the particle instead of that of the subdomain, on the upper half of the ranks.
struct shift_of_wrong_sign : sound_bricks {
    static constexpr const char* breaks = "law 4";
    [[nodiscard]] std::vector<neighbor_rank<2>> neighbors(std::size_t rank, double cutoff) const {
        auto found = bricks_.neighbors(rank, cutoff);
        if (rank >= 3)
            for (auto& other : found) other.shift[0] = -other.shift[0];
        std::sort(found.begin(), found.end());
        return found;
    }
};

using decomposition_twins =
    std::tuple<closed_upper_faces, faces_of_all, rows_are_forgotten, gap_of_one_place, open_top, padded_face,
               two_extended_owners, low_side_is_lost, owner_by_formula, ranks_swapped, owner_of_image, batch_by_formula,
               lost_corner, nearest_only, no_self_image, neighbor_of_itself, named_twice, too_many, one_sided,
               shift_of_wrong_sign>;

}  // namespace tsubu::testing::broken

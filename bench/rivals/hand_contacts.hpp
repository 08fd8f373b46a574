// SPDX-License-Identifier: MIT
/// @file
/// A frictionless step by hand: what one would write for equal spheres with a spring and a dashpot, and for nothing
/// else.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/neighbor/pair_list.hpp>

#include <algorithm>  // std::min
#include <cmath>      // std::sqrt
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint32_t
#include <span>       // std::span
#include <vector>     // std::vector

namespace bench {

/// Spheres of mass 1 and diameter 1 in plain arrays.
struct hand_bed {
    using vec3 = tsubu::vec<3>;
    std::vector<vec3> x, v, f;
    std::vector<tsubu::index_pair> pairs;
    double k = 0;
    double gamma = 0;

    /// The end of a step and the beginning of the next; forces are cleared.
    /// @return the square of the greatest speed: whoever keeps a list of neighbours has to know how long it holds
    [[nodiscard]] double kick_and_drift(double kicked, double drifted) noexcept {
        auto* const at = x.data();
        auto* const speed = v.data();
        auto* const force = f.data();
        const auto count = x.size();
        double fastest = 0;
        for (std::size_t i = 0; i < count; ++i) {
            double square = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                speed[i][a] += kicked * force[i][a];
                at[i][a] += drifted * speed[i][a];
                square += speed[i][a] * speed[i][a];
            }
            fastest = fastest < square ? square : fastest;
            force[i] = {};
        }
        return fastest;
    }
    /// One pair after the other, with a branch.
    void forces_plain() noexcept {
        const auto* const xs = x.data();
        const auto* const vs = v.data();
        auto* const fs = f.data();
        const double stiffness = k;
        const double damping = gamma * 0.5;
        for (const auto [i, j] : pairs) {
            const double dx = xs[i][0] - xs[j][0];
            const double dy = xs[i][1] - xs[j][1];
            const double dz = xs[i][2] - xs[j][2];
            const double square = dx * dx + dy * dy + dz * dz;
            if (square >= 1) continue;
            const double r = std::sqrt(square);
            const double inverse = 1 / r;
            const double nx = dx * inverse;
            const double ny = dy * inverse;
            const double nz = dz * inverse;
            const double vn = (vs[i][0] - vs[j][0]) * nx + (vs[i][1] - vs[j][1]) * ny + (vs[i][2] - vs[j][2]) * nz;
            const double force = stiffness * (1 - r) - damping * vn;
            fs[i][0] += force * nx;
            fs[i][1] += force * ny;
            fs[i][2] += force * nz;
            fs[j][0] -= force * nx;
            fs[j][1] -= force * ny;
            fs[j][2] -= force * nz;
        }
    }
    /// Those that touch are found without a branch, a block at a time, and computed as many at once as there are lanes.
    void forces_in_lanes() noexcept {
        using lanes = tsubu::lanes<double>;
        constexpr auto width = static_cast<std::uint32_t>(lanes::count);
        constexpr std::uint32_t block = 512;
        const auto* const near = pairs.data();
        const auto* const xs = x.data();
        std::uint32_t touching[block + width];
        std::uint32_t waiting = 0;
        const auto count = static_cast<std::uint32_t>(pairs.size());
        for (std::uint32_t begin = 0; begin < count; begin += block) {
            const auto end = (std::min)(count, begin + block);
            for (auto p = begin; p < end; ++p) {
                const auto& a = xs[near[p].i];
                const auto& b = xs[near[p].j];
                const double dx = a[0] - b[0];
                const double dy = a[1] - b[1];
                const double dz = a[2] - b[2];
                touching[waiting] = p;
                waiting += static_cast<std::uint32_t>(dx * dx + dy * dy + dz * dz < 1);
            }
            std::uint32_t done = 0;
            for (; done + width <= waiting; done += width) some<lanes>(touching + done);
            waiting -= done;
            for (std::uint32_t l = 0; l < waiting; ++l) touching[l] = touching[done + l];
        }
        for (std::uint32_t l = 0; l < waiting; ++l) one(pairs[touching[l]]);
    }

private:
    template <class Lanes>
    [[gnu::always_inline]] void some(const std::uint32_t* which) noexcept {
        const auto* const near = pairs.data();
        const auto* const xs = x.data();
        const auto* const vs = v.data();
        auto* const fs = f.data();
        Lanes dx, dy, dz, ux, uy, uz;
        for (std::size_t l = 0; l < Lanes::count; ++l) {
            const auto [i, j] = near[which[l]];
            dx.set(l, xs[i][0] - xs[j][0]);
            dy.set(l, xs[i][1] - xs[j][1]);
            dz.set(l, xs[i][2] - xs[j][2]);
            ux.set(l, vs[i][0] - vs[j][0]);
            uy.set(l, vs[i][1] - vs[j][1]);
            uz.set(l, vs[i][2] - vs[j][2]);
        }
        const Lanes r = tsubu::lanewise::sqrt(dx * dx + dy * dy + dz * dz);
        const Lanes inverse = Lanes(1.0) / r;
        const Lanes nx = dx * inverse;
        const Lanes ny = dy * inverse;
        const Lanes nz = dz * inverse;
        const Lanes force =
            Lanes(k) * (Lanes(1.0) - r) - Lanes(gamma * 0.5) * (ux * nx + uy * ny + uz * nz);
        const Lanes fx = force * nx;
        const Lanes fy = force * ny;
        const Lanes fz = force * nz;
        for (std::size_t l = 0; l < Lanes::count; ++l) {
            const auto [i, j] = near[which[l]];
            fs[i][0] += fx[l];
            fs[i][1] += fy[l];
            fs[i][2] += fz[l];
            fs[j][0] -= fx[l];
            fs[j][1] -= fy[l];
            fs[j][2] -= fz[l];
        }
    }
    void one(const tsubu::index_pair& pair) noexcept {
        const auto* const xs = x.data();
        const auto* const vs = v.data();
        auto* const fs = f.data();
        vec3 d, n;
        double square = 0;
        double vn = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            d[a] = xs[pair.i][a] - xs[pair.j][a];
            square += d[a] * d[a];
        }
        const double r = std::sqrt(square);
        for (std::size_t a = 0; a < 3; ++a) {
            n[a] = d[a] / r;
            vn += (vs[pair.i][a] - vs[pair.j][a]) * n[a];
        }
        const double force = k * (1 - r) - gamma * 0.5 * vn;
        for (std::size_t a = 0; a < 3; ++a) {
            fs[pair.i][a] += force * n[a];
            fs[pair.j][a] -= force * n[a];
        }
    }
};

}  // namespace bench

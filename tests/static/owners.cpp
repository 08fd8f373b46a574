// SPDX-License-Identifier: MIT
/// @file
/// Prints whose points are, in many boxes: for owners.cmake, which compares what different compilers and flags make of
/// it.
#include <tsubu/core/random.hpp>
#include <tsubu/domain/bisection_decomposition.hpp>
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/domain/cell_decomposition.hpp>
#include <tsubu/domain/triclinic_box.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace {

using namespace tsubu;

/// FNV-1a over 64-bit words.
struct fingerprint {
    std::uint64_t value = 14695981039346656037ULL;
    void add(std::uint64_t word) {
        for (int byte = 0; byte < 8; ++byte) value = (value ^ (word >> (8 * byte) & 255U)) * 1099511628211ULL;
    }
    template <class Scalar>
    void add_coordinate(Scalar x) {
        if constexpr (is_lattice<Scalar>)
            add(static_cast<std::uint64_t>(x.value));
        else
            add(static_cast<std::uint64_t>(detail::ordinal(x)));
    }
};

template <class Scalar, std::size_t D>
domain<D, Scalar> some_box(double scale) {
    using box = domain<D, Scalar>;
    typename box::real_position_type lo{};
    typename box::real_position_type hi{};
    typename box::options with{};
    for (std::size_t k = 0; k < D; ++k) {
        const double step = scale * static_cast<double>(k);  // exact: k is 0, 1 or 2
        lo[k] = static_cast<typename box::real_type>(-scale / 7 - step);
        hi[k] = static_cast<typename box::real_type>(scale / 3 + step);
        with.periodic[k] = is_lattice<Scalar> || k != 1;
    }
    return {lo, hi, with};
}
template <class Scalar, std::size_t D>
std::vector<vec<D, Scalar>> some_points(const domain<D, Scalar>& box, std::size_t count) {
    random_stream random(17);
    std::vector<vec<D, Scalar>> points(count);
    for (auto& x : points)
        for (std::size_t k = 0; k < D; ++k) {
            if constexpr (is_lattice<Scalar>)
                x[k] = {static_cast<decltype(x[k].value)>(random())};
            else  // products with powers of 2 alone, which are exact
                x[k] = box.along(k).lo() + box.along(k).length() / static_cast<Scalar>(0.9 + 16 * random.unit());
        }
    return points;
}
template <class Decomposition, class Points>
void add_owners(fingerprint& all, const Decomposition& parts, const Points& points) {
    for (auto x : points) {
        all.add(parts.owner(x));
        const auto mine = parts.subdomain(parts.owner(x));
        for (std::size_t k = 0; k < Decomposition::dimension; ++k) {  // a corner, and beside it
            if constexpr (is_lattice<typename Decomposition::scalar_type>)
                x[k] = parts.whole().along(k).from_real(mine.lo()[k]).position;
            else
                x[k] = mine.lo()[k];
            all.add_coordinate(x[k]);
            all.add(parts.owner(x));
            x[k] = detail::before(x[k]);
            all.add(parts.owner(x));
        }
        if constexpr (!is_lattice<typename Decomposition::scalar_type>) {
            const auto [y, shift] = parts.whole().wrap(x);
            for (std::size_t k = 0; k < Decomposition::dimension; ++k) {
                all.add_coordinate(y[k]);
                all.add(static_cast<std::uint64_t>(shift[k]));
            }
        }
    }
}
template <class Scalar, std::size_t D>
void print_owners(const char* name) {
    for (const double scale : {1e-30, 1e-7, 1.0, 134217728.0, 1e30})
        for (const std::size_t ranks : {1U, 2U, 7U, 24U, 61U}) {
            const auto box = some_box<Scalar, D>(scale);
            const auto points = some_points(box, 300);
            fingerprint all;
            add_owners(all, brick_decomposition<D, Scalar>(box, ranks), points);
            add_owners(all, bisection_decomposition<D, Scalar>(box, ranks, points), points);
            std::vector<double> weights;
            for (std::size_t i = 0; i < points.size(); ++i) weights.push_back(1 / (1 + static_cast<double>(i)));
            add_owners(all, bisection_decomposition<D, Scalar>(box, ranks, points, weights), points);
            std::printf("%s %zu-D scale %g ranks %zu: %016llx\n", name, D, scale, ranks,
                        static_cast<unsigned long long>(all.value));
        }
}
template <class Scalar>
void print_tilted_owners(const char* name) {
    for (const std::size_t ranks : {2U, 7U, 24U}) {
        const triclinic_box<3, Scalar> box({Scalar(-0.1), 0, 3}, {Scalar(1.1), Scalar(0.7), Scalar(1.3)},
                                           {Scalar(0.4), Scalar(-0.3), Scalar(0.6)}, {true, true, true});
        const cell_decomposition parts(box, brick_decomposition<3, Scalar>(box.cell(), ranks));
        fingerprint all;
        random_stream random(5);
        for (int i = 0; i < 1000; ++i) {
            vec<3, Scalar> x{};
            for (auto& coordinate : x) coordinate = static_cast<Scalar>(8 * random.unit() - 3);
            const auto [y, shift] = box.wrap(x);
            all.add(parts.owner(x));
            all.add(parts.owner(y));
            for (std::size_t k = 0; k < 3; ++k) all.add_coordinate(y[k]);
        }
        std::printf("%s tilted, ranks %zu: %016llx\n", name, ranks, static_cast<unsigned long long>(all.value));
    }
}

}  // namespace

int main() {
    print_owners<double, 1>("double");
    print_owners<double, 3>("double");
    print_owners<float, 2>("float");
    print_owners<float, 3>("float");
    print_owners<lattice<std::int32_t>, 3>("lattice32");
    print_owners<lattice<std::int64_t>, 3>("lattice64");
    print_tilted_owners<double>("double");
    print_tilted_owners<float>("float");
}

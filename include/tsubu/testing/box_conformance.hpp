// SPDX-License-Identifier: MIT
/// @file
/// Does a box keep the four laws of its concept? A suite for any test framework, or none.
///
///     tsubu::testing::check_box(my_box, 7, 1000, [](bool ok, std::string_view law) { ... });
#pragma once

#include <tsubu/core/random.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/domain/concepts.hpp>
#include <tsubu/testing/detail/coordinates.hpp>

#include <algorithm>    // std::max
#include <cmath>        // std::abs, std::hypot
#include <concepts>     // std::floating_point
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int64_t, std::uint64_t
#include <limits>       // std::numeric_limits
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <type_traits>  // std::remove_reference_t

namespace tsubu::testing {

/// The laws of box as the suite reports them: a name for each text; never an object.
struct box_law {
    box_law() = delete;

    static constexpr const char* contains = "law 1: contains(x) is cell().contains(to_cell(x))";
    static constexpr const char* wrapped = "law 2: the cell contains what was wrapped, along every periodic axis";
    static constexpr const char* untouched = "law 2: what the box contains stays as it is, with shift 0";
    static constexpr const char* image = "law 3: image takes back what wrap has done";
    static constexpr const char* shortest = "law 4: no image is nearer than minimum_image";
    static constexpr const char* opposite = "law 4: the displacement from b to a is the opposite of that from a to b";
};

}  // namespace tsubu::testing

namespace tsubu::detail {

template <class Box, class Check>
class box_examiner {
    static constexpr std::size_t D = Box::dimension;
    using scalar = typename Box::scalar_type;
    using position = typename Box::position_type;
    using law = testing::box_law;
    static_assert(std::floating_point<scalar>, "the suite asks with positions in floating point");

public:
    box_examiner(const Box& where, std::uint64_t seed, Check& check)
        : where_(where), seed_(seed), random_(seed), check_(check) {
        for (std::size_t corner = 0; corner < std::size_t{1} << D; ++corner) {
            position at{};
            for (std::size_t k = 0; k < D; ++k) {
                const auto inside = where.cell().along(k).inside();
                at[k] = (corner >> k & 1U) != 0 ? inside.last : inside.first;
            }
            const auto x = where.from_cell(at);
            for (const auto coordinate : x) size_ = (std::max)(size_, std::abs(coordinate));
        }
    }
    void examine(std::size_t points) {
        for (std::size_t k = 0; k < D; ++k) {  // half a period apart
            position at{};
            for (std::size_t j = 0; j < D; ++j)
                at[j] = where_.cell().along(j).lo() + where_.cell().along(j).length() / 4;
            const auto a = where_.from_cell(at);
            at[k] += where_.cell().along(k).length() / 2;
            examine_pair(a, where_.from_cell(at));
        }
        bool all_periodic = true;
        for (std::size_t k = 0; k < D; ++k) all_periodic &= where_.cell().along(k).is_periodic();
        for (std::size_t i = 0; i < points; ++i) {
            const auto a = random_inside();
            examine(a);
            for (std::size_t k = 0; k < D; ++k)
                for (const bool up : {false, true}) {
                    auto x = a;
                    x[k] = beside(x[k], up);
                    examine(x);
                }
            const auto b = random_inside();
            auto x = where_.image(a, random_shift(3));
            examine(x);
            examine_pair(a, b);
            examine_pair(x, b);
            if (!all_periodic) continue;  // far beyond a face that is not periodic there may be no image
            for (auto& coordinate : x) coordinate = any_coordinate<scalar>(random_);
            examine(x);
        }
    }

private:
    [[nodiscard]] position random_inside() {
        position at{};
        for (std::size_t k = 0; k < D; ++k) {
            const auto [first, last] = where_.cell().along(k).inside();
            at[k] = random_.below(8) == 0 ? (random_.below(2) == 0 ? first : last)
                                          : coordinate_between(first, last, random_);
        }
        return where_.from_cell(at);
    }
    [[nodiscard]] image_shift<D> random_shift(std::int64_t most) {
        image_shift<D> shift{};
        for (std::size_t k = 0; k < D; ++k)
            if (where_.cell().along(k).is_periodic())
                shift[k] = static_cast<std::int64_t>(random_.below(static_cast<std::uint64_t>(2 * most + 1))) - most;
        return shift;
    }
    void examine(const position& x) {
        const auto what = [&] { return shown(x); };
        const bool inside = where_.contains(x);
        expect(inside == where_.cell().contains(where_.to_cell(x)), law::contains, what);
        const auto [y, shift] = where_.wrap(x);
        const auto at = where_.to_cell(y);
        bool is_wrapped = true;
        for (std::size_t k = 0; k < D; ++k)
            is_wrapped &= !where_.cell().along(k).is_periodic() || where_.cell().along(k).contains(at[k]);
        expect(is_wrapped, law::wrapped, [&, to = y] { return shown(x) + " became " + shown(to); });
        expect(!inside || (y == x && shift == image_shift<D>{}), law::untouched, what);
        bool is_countable = true;  // beyond 2^53 periods no number tells one from the next
        for (const auto n : shift) is_countable &= n < (std::int64_t{1} << 53) && n > -(std::int64_t{1} << 53);
        if (!is_countable) return;
        const auto back = where_.image(y, shift);
        scalar largest = size_;  // of what was added up
        for (const auto n : shift) largest = (std::max)(largest, size_ * static_cast<scalar>(n < 0 ? -n : n));
        for (const auto coordinate : x) largest = (std::max)(largest, std::abs(coordinate));
        bool is_back = true;
        for (std::size_t k = 0; k < D; ++k) is_back &= std::abs(back[k] / largest - x[k] / largest) <= rounding;
        expect(is_back, law::image, [&] { return shown(x) + " came back as " + shown(back); });
    }
    void examine_pair(const position& a, const position& b) {
        const auto d = where_.minimum_image(a, b);
        const auto what = [&] { return shown(a) + " from " + shown(b) + ": " + shown(d); };
        const auto shortest = length_of(d);
        const auto from = where_.wrap(a);
        for (int i = 0; i < 20; ++i) {
            const auto other = where_.image(from.position, random_shift(2));
            auto e = other;
            for (std::size_t k = 0; k < D; ++k) e[k] -= b[k];
            expect(shortest <= length_of(e) + rounding * (size_ + length_of(a)), law::shortest, what);
        }
        // Where images are turned, the two differ by the turn.
        if constexpr (!cyclic_box<Box>) {
            const auto back = where_.minimum_image(b, a);
            bool is_opposite = true;
            for (std::size_t k = 0; k < D; ++k) is_opposite &= back[k] == -d[k];
            expect(is_opposite, law::opposite, what);
        }
    }
    [[nodiscard]] static scalar length_of(const position& d) {
        scalar length = 0;
        for (const auto component : d) length = std::hypot(length, component);
        return length;
    }
    template <class What>
    void expect(bool kept, const char* text, What&& what) {
        if (kept) return check_(true, std::string_view(text));
        check_(false, std::string_view(std::string(text) + "; x = " + what() + "; seed " + shown(seed_)));
    }

    static constexpr scalar rounding = 64 * std::numeric_limits<scalar>::epsilon();

    const Box& where_;
    std::uint64_t seed_;
    random_stream random_;
    Check& check_;
    scalar size_ = 0;  // no coordinate of the box is larger
};

}  // namespace tsubu::detail

namespace tsubu::testing {

/// Does this box keep laws 1 to 4?
///
/// @param seed    same seed, same run, on every machine
/// @param points  inside, as many images of such, and, if all is periodic, as many anywhere
/// @param check   called as check(bool kept, std::string_view law), many times per point; a broken law with the point
///                and the seed behind its text
template <box Box, class Check>
void check_box(const Box& where, std::uint64_t seed, std::size_t points, Check&& check) {
    detail::box_examiner<Box, std::remove_reference_t<Check>> examiner(where, seed, check);
    examiner.examine(points);
}

}  // namespace tsubu::testing

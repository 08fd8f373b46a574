// SPDX-License-Identifier: MIT
/// @file
/// Does a border policy keep its four laws on a given axis? A suite for any test framework, or none.
///
///     tsubu::testing::check_border(my_border{}, tsubu::cuts(axis, 8), [](bool ok, std::string_view law) { ... });
///
/// What a part owns is an interval, so it changes at the ends of intervals only: asked at all of them and beside them,
/// the laws hold everywhere if they hold there.
#pragma once

#include <tsubu/core/shown.hpp>
#include <tsubu/domain/border.hpp>
#include <tsubu/domain/cuts.hpp>

#include <algorithm>    // std::sort
#include <cstddef>      // std::size_t
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <vector>       // std::vector

namespace tsubu::testing {

/// The laws of border_policy as the suite reports them: a name for each text; never an object.
struct border_law {
    border_law() = delete;

    static constexpr const char* owned = "law 1: one part owns a coordinate inside the axis, and none any other";
    static constexpr const char* extended = "law 2: owned_extended of one part has any finite coordinate";
    static constexpr const char* of_cuts = "law 4: owned_extended of the part that the cuts tell has the coordinate";
    static constexpr const char* same = "law 3: inside the axis a part owns the same by both";
};

/// Does this border policy keep laws 1 to 4 for these parts of an axis?
///
/// @param check  called as check(bool kept, std::string_view law), four times per coordinate; a broken law with the
///               coordinate behind its text
/// Complexity: O(parts^2).
template <class Scalar, border_policy<Scalar> Border, class Check>
void check_border(const Border& border, const cuts<Scalar>& where, Check&& check) {
    const auto all = interval<Scalar>::all();
    const auto inside = where.whole().inside();
    std::vector<Scalar> asked = {all.first, all.last, inside.first, inside.last};
    std::vector<interval<Scalar>> owned;
    std::vector<interval<Scalar>> extended;
    for (std::size_t part = 0; part < where.parts(); ++part) {
        owned.push_back(border.owned(where, part));
        extended.push_back(border.owned_extended(where, part));
        for (const auto x :
             {where.begin(part), owned[part].first, owned[part].last, extended[part].first, extended[part].last})
            asked.push_back(x);
    }
    for (std::size_t i = asked.size(); i-- > 0;) {
        asked.push_back(detail::before(asked[i]));
        asked.push_back(detail::after(asked[i]));
    }
    std::sort(asked.begin(), asked.end());
    asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
    const auto report = [&](bool kept, const char* text, Scalar x) {
        if (kept) return check(true, std::string_view(text));
        check(false,
              std::string_view(std::string(text) + "; x = " + detail::shown(x) + " of " + detail::shown(where.parts()) +
                               " parts from " + detail::shown(where.whole().inside().first) + " to " +
                               detail::shown(where.whole().inside().last)));
    };
    for (const auto x : asked) {
        std::size_t owners = 0;
        std::size_t extended_owners = 0;
        bool same = true;
        for (std::size_t part = 0; part < where.parts(); ++part) {
            owners += owned[part].contains(x) ? 1U : 0U;
            extended_owners += extended[part].contains(x) ? 1U : 0U;
            same = same && owned[part].contains(x) == extended[part].contains(x);
        }
        const bool is_inside = where.whole().contains(x);
        report(owners == (is_inside ? 1U : 0U), border_law::owned, x);
        report(extended_owners == 1, border_law::extended, x);
        report(!is_inside || same, border_law::same, x);
        report(extended[where.part_of(x)].contains(x), border_law::of_cuts, x);
    }
}

/// The same for `parts` equal parts of an axis.
template <class Scalar, border_policy<Scalar> Border, class Check>
void check_border(const Border& border, const axis<Scalar>& along, std::size_t parts, Check&& check) {
    check_border(border, cuts<Scalar>(along, parts), check);
}

}  // namespace tsubu::testing

// SPDX-License-Identifier: MIT
/// @file
/// Do the laws of rolling and cohesion keep what their concepts say, and do the suites catch what they are there for?
#include <tsubu/testing/rolling_law_conformance.hpp>

#include <tsubu/dem/laws/dmt_cohesion.hpp>
#include <tsubu/dem/laws/rolling_resistance.hpp>
#include <tsubu/testing/cohesion_law_conformance.hpp>

#include "support/catch.hpp"
#include "support/verdict.hpp"

#include <cstddef>
#include <set>
#include <string>
#include <type_traits>

namespace {

using namespace tsubu::dem;
using tsubu::vec;

template <std::size_t D, class Law>
verdict judged(const Law& law) {
    verdict seen;
    tsubu::testing::check_rolling_law<D>(law, 2e5, seen);
#if defined(__FMA__) || defined(__FP_FAST_FMA)
    seen.broken.erase("law 6");  // products are fused, in lanes otherwise than alone
#endif
    return seen;
}

/// A law that is sound but for what Spoil does to it.
template <class Spoil>
struct spoiled : rolling_resistance {
    template <std::size_t D, class Real>
    [[nodiscard]] vec<spin_count<D>, Real> torque(const contact<D, Real>& at, const Real& normal_force,
                                                  const Real& stiffness, vec<spin_count<D>, Real>& spring) const {
        auto result = rolling_resistance::torque<D, Real>(at, normal_force, stiffness, spring);
        if constexpr (std::is_same_v<Real, double>) Spoil{}(result, at, spring);
        return result;
    }
};
struct twists {
    template <class Vector, class Contact>
    void operator()(Vector& torque, const Contact& at, Vector&) const {
        if constexpr (Contact::spins == 3) torque = plus(torque, scaled(at.normal, 1e-3 * torque[0]));
    }
};
struct knows_no_limit {
    template <class Vector, class Contact>
    void operator()(Vector& torque, const Contact&, Vector&) const {
        torque = scaled(torque, 3.0);
    }
};
struct drives {
    template <class Vector, class Contact>
    void operator()(Vector& torque, const Contact&, Vector&) const {
        torque = scaled(torque, -1.0);
    }
};
struct resists_twisting {
    template <class Vector, class Contact>
    void operator()(Vector& torque, const Contact& at, Vector&) const {
        torque = minus(torque, at.turning);
    }
};
struct counts_calls {
    template <class Vector, class Contact>
    void operator()(Vector&, const Contact&, Vector& spring) const {
        spring = scaled(spring, 0.5);
    }
};
struct takes_sides {
    template <class Vector, class Contact>
    void operator()(Vector& torque, const Contact& at, Vector&) const {
        if (at.normal[0] > 0) torque = scaled(torque, 0.5);
    }
};
struct other_alone {
    template <class Vector, class Contact>
    void operator()(Vector& torque, const Contact&, Vector&) const {
        torque = scaled(torque, 1 - 0x1p-50);
    }
};
using laws = std::set<std::string>;
template <class Spoil>
laws broken_by() {
    return judged<3>(spoiled<Spoil>{{.1, .2}}).broken;
}

struct pushing : dmt_cohesion {
    template <class Real>
    [[nodiscard]] Real pull(const Real& radius) const {
        return -dmt_cohesion::pull(radius);
    }
};
struct other_in_lanes : dmt_cohesion {
    using dmt_cohesion::pull;
    [[nodiscard]] tsubu::lanes<float> pull(const tsubu::lanes<float>& radius) const { return radius; }
};
template <class Law>
laws broken_by(const Law& law) {
    verdict seen;
    tsubu::testing::check_cohesion_law(law, seen);
    return seen.broken;
}

}  // namespace

TEST_CASE("rolling resistance keeps its laws", "[dem][conformance]") {
    const auto check = [](const verdict& seen) {
        INFO(seen.first);
        CHECK(seen.broken.empty());
        CHECK(seen.checked > 1900);
    };
    check(judged<2>(rolling_resistance{.1}));
    check(judged<3>(rolling_resistance{.1, .2}));
}
TEST_CASE("a law of rolling that breaks one is caught", "[dem][conformance]") {
    CHECK(broken_by<twists>().count("law 1") == 1);
    CHECK(broken_by<knows_no_limit>().count("law 2") == 1);
    CHECK(broken_by<drives>().count("law 3") == 1);
    CHECK(broken_by<resists_twisting>().count("law 3") == 1);
    CHECK(broken_by<counts_calls>().count("law 4") == 1);
    CHECK(broken_by<takes_sides>().count("law 5") == 1);
#if !defined(__FMA__) && !defined(__FP_FAST_FMA)
    CHECK(broken_by<other_alone>() == laws{"law 6"});
#endif
}
TEST_CASE("a law of cohesion keeps its laws, and one that breaks them is caught", "[dem][conformance]") {
    CHECK(broken_by(dmt_cohesion{.05}).empty());
    CHECK(broken_by(pushing{{.05}}) == laws{"law 1"});
    CHECK(broken_by(other_in_lanes{{.05}}) == laws{"law 2"});
}

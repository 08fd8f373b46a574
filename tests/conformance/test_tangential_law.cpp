// SPDX-License-Identifier: MIT
/// @file
/// Do the laws of friction keep what their concept says, and does the suite catch what it is there for?
#include <tsubu/testing/tangential_law_conformance.hpp>

#include <tsubu/dem/laws/coulomb.hpp>
#include <tsubu/dem/laws/linear_history.hpp>
#include <tsubu/dem/laws/mindlin_history.hpp>

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
    tsubu::testing::check_tangential_law<D>(law, seen);
#if defined(__FMA__) || defined(__FP_FAST_FMA)
    seen.broken.erase("law 6");  // products are fused, in lanes otherwise than alone
#endif
    return seen;
}
template <class Law>
void check_kept(const Law& law) {
    const auto check = [](const verdict& seen) {
        INFO(seen.first);
        CHECK(seen.broken.empty());
        CHECK(seen.checked > 1900);
    };
    check(judged<2>(law));
    check(judged<3>(law));
}

/// A law that is sound but for what spoil(force, contact, history before, history after) does to it.
template <class Spoil>
struct spoiled : linear_history {
    template <std::size_t D, class Real>
    [[nodiscard]] vec<D, Real> force(const contact<D, Real>& at, const Real& normal_force, const Real& damping,
                                     vec<D, Real>& spring) const {
        auto result = linear_history::force<D, Real>(at, normal_force, damping, spring);
        if constexpr (std::is_same_v<Real, double>) Spoil{}(result, at, normal_force, spring);
        return result;
    }
};
struct leaks_along_the_normal {
    template <class Vector, class Contact>
    void operator()(Vector& force, const Contact& at, double, Vector&) const {
        force = plus(force, scaled(at.normal, 1e-3 * std::abs(force[0])));
    }
};
struct knows_no_limit {
    template <class Vector, class Contact>
    void operator()(Vector& force, const Contact&, double normal_force, Vector&) const {
        if (std::abs(normal_force) < 1e9) force = scaled(force, 3.0);
    }
};
struct drives {
    template <class Vector, class Contact>
    void operator()(Vector& force, const Contact&, double, Vector&) const {
        force = scaled(force, -1.0);
    }
};
struct creeps {
    template <class Vector, class Contact>
    void operator()(Vector&, const Contact& at, double, Vector& spring) const {
        spring = plus(spring, scaled(at.normal, at.time_step * 1e-3));
    }
};
struct counts_calls {
    template <class Vector, class Contact>
    void operator()(Vector&, const Contact& at, double, Vector& spring) const {
        spring = plus(spring, scaled(slip_of(at), 1e-4));
    }
};
struct takes_sides {
    template <class Vector, class Contact>
    void operator()(Vector& force, const Contact& at, double, Vector&) const {
        if (at.normal[0] > 0) force = scaled(force, 0.5);
    }
};
struct other_alone {
    template <class Vector, class Contact>
    void operator()(Vector& force, const Contact&, double, Vector&) const {
        force = scaled(force, 1 - 0x1p-50);
    }
};
struct hides_its_dashpot : linear_history {
    [[nodiscard]] double viscosity(double, double) const { return 0; }
};
struct wrong_stiffness : linear_history {
    [[nodiscard]] double stiffness(double, double) const { return k_t / 2; }
};

using laws = std::set<std::string>;
template <class Spoil>
laws broken_by() {
    return judged<3>(spoiled<Spoil>{{5e4, .5, 20}}).broken;
}

}  // namespace

TEST_CASE("the shipped laws of friction keep their laws", "[dem][conformance]") {
    check_kept(coulomb{.5, 30});
    check_kept(linear_history{5e4, .5, 20});
    check_kept(mindlin_history{4e6, .3, .7});
}
TEST_CASE("a law of friction that breaks one is caught", "[dem][conformance]") {
    CHECK(judged<3>(spoiled<decltype([](auto&&...) {})>{{5e4, .5, 20}}).broken.empty());
    CHECK(broken_by<leaks_along_the_normal>().count("law 1") == 1);
    CHECK(broken_by<knows_no_limit>().count("law 2") == 1);
    CHECK(broken_by<drives>().count("law 3") == 1);
    CHECK(broken_by<creeps>().count("law 3") == 1);
    CHECK(broken_by<counts_calls>().count("law 4") == 1);
    CHECK(broken_by<takes_sides>().count("law 5") == 1);
#if !defined(__FMA__) && !defined(__FP_FAST_FMA)
    CHECK(broken_by<other_alone>() == laws{"law 6"});
#endif
    CHECK(judged<3>(hides_its_dashpot{{5e4, .5, 20}}).broken == laws{"law 7"});
    CHECK(judged<3>(wrong_stiffness{{5e4, .5, 20}}).broken == laws{"law 8"});
}

// SPDX-License-Identifier: MIT
/// @file
/// Do the normal laws keep what their concept says, and does the suite catch what it is there for?
#include <tsubu/testing/normal_law_conformance.hpp>

#include <tsubu/dem/contact_law.hpp>

#include "support/catch.hpp"
#include "support/verdict.hpp"

namespace {

using namespace tsubu::dem;

template <class Law>
verdict judged(const Law& law) {
    verdict seen;
    tsubu::testing::check_normal_law(law, 1e-2, seen);
    return seen;
}

/// Each breaks one law.
struct adhesive_start : hooke_normal {
    template <class Real>
    [[nodiscard]] Real elastic(const Real& overlap, const Real& radius) const noexcept {
        return hooke_normal::elastic(overlap, radius) - Real(1);
    }
};
struct wrong_stiffness : hertz_normal {
    template <class Real>
    [[nodiscard]] Real stiffness(const Real& overlap, const Real& radius) const noexcept {
        return hertz_normal::stiffness(overlap, radius) * Real(1.5);
    }
};
struct wrong_energy : hooke_normal {
    template <class Real>
    [[nodiscard]] Real energy(const Real& overlap, const Real& radius) const noexcept {
        return elastic(overlap, radius) * overlap;
    }
};
struct softening : hooke_normal {
    template <class Real>
    [[nodiscard]] Real elastic(const Real& overlap, const Real&) const noexcept {
        return -(overlap * constant<Real>(k));
    }
};
struct driving : hooke_dashpot_normal {
    template <class Real>
    [[nodiscard]] Real damping(const Real& overlap, const Real& mass, const Real& radius) const noexcept {
        return -hooke_dashpot_normal::damping(overlap, mass, radius);
    }
};
struct secretly_damped : hooke_normal {
    template <class Real>
    [[nodiscard]] Real damping(const Real&, const Real& mass, const Real&) const noexcept {
        return mass;
    }
};
struct other_in_lanes : hooke_normal {
    using hooke_normal::elastic;
    [[nodiscard]] tsubu::lanes<double> elastic(const tsubu::lanes<double>& overlap,
                                               const tsubu::lanes<double>&) const noexcept {
        return overlap * tsubu::lanes<double>(k) * tsubu::lanes<double>(1 + 0x1p-50);
    }
};
struct other_stiffness_in_lanes : hertz_normal {
    using hertz_normal::stiffness;
    [[nodiscard]] tsubu::lanes<float> stiffness(const tsubu::lanes<float>& overlap,
                                                const tsubu::lanes<float>&) const noexcept {
        return overlap;
    }
};

}  // namespace

TEST_CASE("the shipped normal laws keep their laws", "[dem][conformance]") {
    const auto check = [](const auto& law) {
        const auto seen = judged(law);
        INFO(seen.first);
        CHECK(seen.broken.empty());
        CHECK(seen.checked > 500);
    };
    check(hooke_normal{2e5});
    check(hooke_dashpot_normal{2e5, 50});
    check(hertz_normal{1e7});
    check(hertz_dashpot_normal{1e7, 300});
    check(hertz_tsuji_normal{1e7, 0.3});
}
TEST_CASE("a normal law that breaks one is caught", "[dem][conformance]") {
    CHECK(judged(adhesive_start{{1e3}}).broken.count("law 1") == 1);
    CHECK(judged(wrong_stiffness{{1e7}}).broken.count("law 1") == 1);
    CHECK(judged(wrong_energy{{1e3}}).broken.count("law 1") == 1);
    CHECK(judged(softening{{1e3}}).broken.count("law 1") == 1);
    CHECK(judged(driving{{1e3, 5}}).broken.count("law 2") == 1);
    CHECK(judged(secretly_damped{{1e3}}).broken.count("law 2") == 1);
    CHECK(judged(other_in_lanes{{1e3}}).broken.count("law 3") == 1);
    CHECK(judged(other_stiffness_in_lanes{{1e3}}).broken.count("law 3") == 1);
}

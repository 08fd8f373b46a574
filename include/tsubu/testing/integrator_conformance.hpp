// SPDX-License-Identifier: MIT
/// @file
/// Does an integrator keep its laws on one oscillator? A suite for any test framework, or none.
///
///     tsubu::testing::check_integrator<my_integrator>({.order = 2, .damped_order = 1},
///                                                      [](bool ok, std::string_view law) { ... });
///
/// The run that is moved is oscillator_run: one particle on a spring and a dashpot in one dimension, without
/// neighbours, ranks and guards; damping that is to be solved for is solved in closed form there. What the suite cannot
/// see is spin, and whether neighbours and ghosts are followed, which a run does.
#pragma once

#include <tsubu/core/shown.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/integrator.hpp>
#include <tsubu/dem/quantities.hpp>
#include <tsubu/store/field.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <algorithm>    // std::max
#include <cmath>        // std::abs, std::cos, std::exp, std::hypot, std::log2, std::sin, std::sqrt
#include <cstddef>      // std::size_t
#include <string>       // std::string
#include <string_view>  // std::string_view

namespace tsubu::testing {

/// x'' = -omega^2 x - 2 z omega x', with all that an integrator may call of a run.
///
/// @tparam Integrator  whose fields the particle has
template <dem::integrator Integrator>
class oscillator_run {
public:
    /// What an integrator may ask of the type of a run.
    struct simulation_type {
        static constexpr std::size_t dimension = 1;
        using quantities_type = dem::quantities<1, double>;
        using real = double;
    };
    using quantities_type = typename simulation_type::quantities_type;
    using fields_type =
        union_of<fields<tsubu::id, quantities_type::position, quantities_type::velocity, quantities_type::force>,
                 typename Integrator::template keeps<quantities_type>>;

    /// At x [m] with velocity v [m/s], and the force there; its mass is 1.
    /// @param omega  [rad/s]; 0: no force at all
    /// @param z      damping ratio
    oscillator_run(double omega, double z, double x, double v) : stiffness_(omega * omega), damping_(2 * z * omega) {
        store_.push_back(tsubu::id = 1, quantities_type::position = {x}, quantities_type::velocity = {v});
        find_force(0);
    }
    /// Steps of h [s].
    void steps(double h, std::size_t count) {
        time_step_ = h;
        Integrator::advance(*this, h, count);
    }
    [[nodiscard]] double x() const noexcept { return store_[quantities_type::position][0][0]; }
    [[nodiscard]] double v() const noexcept { return store_[quantities_type::velocity][0][0]; }
    [[nodiscard]] double force() const noexcept { return store_[quantities_type::force][0][0]; }
    /// What the spring does at x.
    [[nodiscard]] double spring_force() const noexcept { return -stiffness_ * x(); }
    /// How often the force has been asked for.
    [[nodiscard]] std::size_t evaluations() const noexcept { return evaluations_; }
    [[nodiscard]] std::size_t steps_done() const noexcept { return steps_done_; }
    /// Whether forces were clear whenever they were evaluated.
    [[nodiscard]] bool was_clear() const noexcept { return was_clear_; }

    // What integrators are made of, as in dem::run.

    [[nodiscard]] auto& particles() noexcept { return store_; }
    void kick(double duration) noexcept { velocity() += duration * force(); }
    void drift(double duration) noexcept { place() += duration * v(); }
    template <bool Twice>
    void kick_and_drift(double kicked, double drifted) noexcept {
        kick(Twice ? 2 * kicked : kicked);
        drift(drifted);
        clear_forces();
    }
    template <class Step>
    void displace(Step&& step) {
        place() += step(std::size_t{0})[0];
    }
    void clear_forces() noexcept { store_[quantities_type::force][0][0] = 0; }
    [[nodiscard]] vec<1> acceleration(std::size_t) const noexcept { return {force()}; }
    void evaluate_forces() {
        ++evaluations_;
        was_clear_ = was_clear_ && force() == 0;
        find_force(time_step_);
    }
    void end_step() noexcept { ++steps_done_; }

private:
    [[nodiscard]] double& place() noexcept { return store_[quantities_type::position][0][0]; }
    [[nodiscard]] double& velocity() noexcept { return store_[quantities_type::velocity][0][0]; }
    void find_force(double time_step) noexcept {
        auto& f = store_[quantities_type::force][0][0];
        f += spring_force();
        // Where damping is solved for, it is that of the velocity after half a step with it.
        if constexpr (Integrator::solves_damping)
            f -= damping_ * (v() + time_step / 2 * f) / (1 + time_step / 2 * damping_);
        else
            f -= damping_ * v();
    }

    particle_store<fields_type> store_;
    double stiffness_;
    double damping_;
    double time_step_ = 0;
    std::size_t evaluations_ = 0;
    std::size_t steps_done_ = 0;
    bool was_clear_ = true;
};

/// What an integrator claims beyond its members.
struct integrator_claims {
    double order;                ///< for smooth forces of positions
    double damped_order;         ///< where they depend on velocities
    bool is_limit_exact = true;  ///< whether stable_until is the limit with damping too, or somewhere below
};

/// The laws of integrator as the suite reports them: a name for each text; never an object.
struct integrator_law {
    integrator_law() = delete;

    static constexpr const char* straight = "law 1: without forces the velocity stays, and x is v t";
    static constexpr const char* clear = "law 1: forces are clear before they are evaluated";
    static constexpr const char* after = "law 1: after an advance the forces are those of the positions";
    static constexpr const char* apart = "law 1: steps in one advance and in several are the same, to rounding";
    static constexpr const char* none = "law 1: no steps change nothing";
    static constexpr const char* ended = "law 1: end_step is called once for each step";
    static constexpr const char* cost = "law 2: a step takes force_evaluations, and an advance one more at most";
    static constexpr const char* bounded = "law 4: an oscillator does not grow below stable_until";
    static constexpr const char* grows = "law 4: an oscillator grows above stable_until";
    static constexpr const char* order = "claim: the order is the one that is claimed";
};

/// Does this integrator keep laws 1, 2 and 4, and the claims?
///
/// @param check  called as check(bool kept, std::string_view law); a broken law with the step, or what was measured,
///               behind its text
template <dem::integrator Integrator, class Check>
void check_integrator(const integrator_claims& claims, Check&& check) {
    using run = oscillator_run<Integrator>;
    const auto report = [&](bool kept, const char* text, const char* of, double value) {
        if (kept) return check(true, std::string_view(text));
        check(false, std::string_view(std::string(text) + ": " + of + " " + detail::shown(value)));
    };
    const auto is_near = [](double a, double b) { return std::abs(a - b) <= 1e-12 * (std::max)(1.0, std::abs(b)); };

    {
        run free(0, 0, 1, 3);
        free.steps(0.25, 40);
        report(free.v() == 3 && is_near(free.x(), 31), integrator_law::straight, "x is", free.x());
    }
    for (const double z : {0.0, 0.4}) {
        run once(1, z, 1, 0.5);
        run often(1, z, 1, 0.5);
        constexpr std::size_t count = 12;
        once.steps(0.1, count);
        for (std::size_t n = 0; n < count; ++n) often.steps(0.1, 1);
        report(once.was_clear(), integrator_law::clear, "damping ratio", z);
        report(is_near(once.x(), often.x()) && is_near(once.v(), often.v()), integrator_law::apart, "damping ratio", z);
        const double x = once.x();
        const double v = once.v();
        once.steps(0.1, 0);
        report(once.x() == x && once.v() == v, integrator_law::none, "x is", once.x());
        // With damping the force is that of a velocity within the step.
        if (z == 0) report(is_near(once.force(), once.spring_force()), integrator_law::after, "force", once.force());
        report(once.steps_done() == count, integrator_law::ended, "steps", static_cast<double>(once.steps_done()));
        const auto cost = [&](std::size_t steps) {
            const auto before = once.evaluations();
            once.steps(0.1, steps);
            return once.evaluations() - before;
        };
        const auto of_many = cost(count);
        const auto of_one = cost(1);
        report(of_many - of_one == (count - 1) * Integrator::force_evaluations &&
                   of_one >= Integrator::force_evaluations && of_one <= Integrator::force_evaluations + 1,
               integrator_law::cost, "evaluations", static_cast<double>(of_many));
    }

    // The order: errors after a time of 6 with two steps, one half of the other.
    const auto error = [](double z, std::size_t count) {
        run one(1, z, 1, 0.5);
        one.steps(6.0 / static_cast<double>(count), count);
        const double w = std::sqrt(1 - z * z);
        const double sine = (0.5 + z) / w;
        const double decay = std::exp(-z * 6);
        const double x = decay * (std::cos(w * 6) + sine * std::sin(w * 6));
        const double v = decay * w * (sine * std::cos(w * 6) - std::sin(w * 6)) - z * x;
        return std::hypot(one.x() - x, one.v() - v);
    };
    for (const double z : {0.0, 0.4}) {
        const double order = std::log2(error(z, 60) / error(z, 120));
        report(std::abs(order - (z == 0 ? claims.order : claims.damped_order)) < 0.2, integrator_law::order, "measured",
               order);
    }

    // Growth: the greatest amplitude of the second half of many steps is above that of the first. A step that is almost
    // at the limit beats; the first half is longer than that.
    const auto grows = [](double z, double h) {
        run one(1, z, 1, 0.5);
        double most[2] = {0, 0};
        for (double& half : most)
            for (std::size_t n = 0; n < 1000; ++n) {
                one.steps(h, 1);
                half = (std::max)(half, std::hypot(one.x(), one.v()));
                if (!(half < 1e9)) return true;
            }
        return most[1] > 1.01 * most[0];
    };
    for (const double z : {0.0, 0.4, 1.0}) {
        const double limit = Integrator::stable_until(z);
        if (limit > 0)
            for (const double share : {0.1, 0.5, 0.8, 0.99})
                report(!grows(z, share * limit), integrator_law::bounded, "omega h =", share * limit);
        if (z == 0 || claims.is_limit_exact)
            report(grows(z, limit > 0 ? 1.01 * limit : 0.1), integrator_law::grows, "omega h =", 1.01 * limit);
    }
}

}  // namespace tsubu::testing

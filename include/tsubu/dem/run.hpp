// SPDX-License-Identifier: MIT
/// @file
/// run: a scene with its particles, in time.
#pragma once

#include <tsubu/comm/agreement.hpp>
#include <tsubu/comm/duplicate_ids.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/expects.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/detail/checks.hpp>
#include <tsubu/dem/detail/columns.hpp>
#include <tsubu/dem/detail/contact_kernel.hpp>
#include <tsubu/dem/detail/damping_solver.hpp>
#include <tsubu/dem/detail/motion.hpp>
#include <tsubu/dem/detail/neighborhood.hpp>
#include <tsubu/dem/contact_pair.hpp>
#include <tsubu/dem/options.hpp>
#include <tsubu/dem/simulation.hpp>
#include <tsubu/neighbor/pair_list.hpp>

#include <cmath>        // std::sqrt
#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint64_t
#include <span>         // std::span
#include <string>       // std::to_string
#include <tuple>        // std::get, std::tuple, std::tuple_size_v
#include <type_traits>  // std::is_constructible_v

namespace tsubu::dem {

/// A scene that runs: what a simulation says, made for a box, a transport and parameters; see make_run.
template <class Simulation, transport Transport>
class run {
    static_assert(sizeof(Simulation) == 0, "what runs is a tsubu::dem::simulation<D, Number, Integrator, Models...>");
};

/// A scene with its particles on the ranks of a transport.
///
///     auto bed = tsubu::dem::make_run<scene>(box, {.time_step = 1e-4, .skin = 0.1}, on, law, gravity, grains);
///     bed.particles().push_back(tsubu::id = 1, tsubu::position<3> = {1, 1, 1});
///     bed.start();
///     bed.steps(1000);
///
/// The models are given in the order of the scene's; equal_spheres last, where the scene does not name it. The
/// transport must outlive the run.
///
/// Collective: start, resume, change and steps, with the same box, options and models on all ranks.
/// Threads:    one at a time.
template <std::size_t D, number_policy Number, integrator Integrator, model... Models, transport Transport>
class run<simulation<D, Number, Integrator, Models...>, Transport> {
public:
    using simulation_type = simulation<D, Number, Integrator, Models...>;
    using box_type = typename simulation_type::box_type;
    using store_type = typename simulation_type::store_type;
    using real = typename simulation_type::real;
    using transport_type = Transport;

    /// @throws input_error if a parameter is not what it may be; the message names it, and the remedy.
    run(const box_type& box, const options& how, Transport& on, const Models&... models)
        requires simulation_type::names_bodies
        : run(box, how, on, std::tuple<Models...>(models...)) {}
    run(const box_type& box, const options& how, Transport& on, const Models&... models, const equal_spheres& bodies)
        requires(!simulation_type::names_bodies)
        : run(box, how, on, std::tuple<Models..., equal_spheres>(models..., bodies)) {}
    run(const run&) = delete;
    run& operator=(const run&) = delete;
    ~run() = default;

    /// The particles of this rank; ghosts follow the owned ones. Before start add them here, afterwards by change.
    [[nodiscard]] store_type& particles() noexcept { return store_; }
    [[nodiscard]] const store_type& particles() const noexcept { return store_; }
    [[nodiscard]] const box_type& box() const noexcept { return near_.box(); }
    [[nodiscard]] Transport& on() const noexcept { return *on_; }
    [[nodiscard]] const options& how() const noexcept { return how_; }
    /// The parameters of a model.
    template <class Model>
    [[nodiscard]] const Model& model() const noexcept {
        return std::get<Model>(models_);
    }
    /// Since this run was made: a restart does not tell how many there were before.
    [[nodiscard]] std::uint64_t steps_done() const noexcept { return steps_; }
    /// How often neighbours have been found.
    [[nodiscard]] std::uint64_t renewals() const noexcept { return near_.renewals(); }
    /// Which particles are near each other.
    [[nodiscard]] std::span<const index_pair> pairs() const noexcept { return near_.pairs(); }
    /// What particles, lists and histories of contacts take on this rank, without halo and id maps [bytes].
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return store_.memory_bytes() + near_.memory_bytes(); }

    /// Particles go to their ranks, neighbours are found, and forces computed. Contacts begin without a history, but
    /// for that which particles of a restart bring with them.
    /// @throws on all ranks or none: input_error if a particle is not what it may be, or a guard refuses.
    void start() { begin(true); }
    /// As start, for particles of a restart: they have their forces.
    void resume() { begin(false); }
    /// body(particles()) adds, removes or changes particles; then as start, but contacts keep their history where both
    /// of their particles remain. Forces are computed anew: a dashpot sees velocities of the full step for once.
    ///
    ///     bed.change([](auto& grains) { if (!grains.empty()) grains.swap_remove(0); });
    ///
    /// Collective: yes; each rank changes particles of its own.
    /// @throws on all ranks or none: as start; or what body throws. Particles are as body left them then.
    template <class Body>
    void change(Body&& body) {
        if (is_started_) keep_history();
        is_started_ = false;
        partners_ = partners::may_be_gone;
        columns_hold_ = false;
        agreement<> all(on_->rank());
        all.attempt([&] {
            store_.clear_ghosts();
            body(store_);
        });
        on_->reduce(all.words(), reduction::sum);
        all.settle("dem::run::change", "particles are as the body left them");
        begin(true);
    }
    /// So many time steps. @throws on all ranks or none: input_error if neighbours were used too long, a particle left
    /// the box, or a guard refuses. Particles are somewhere within a step then: look at
    /// them in particles(), or go back to a restart; measures need a start.
    void steps(std::size_t count) {
        if (!is_started_) start();
        check_count("dem::run::steps");
        at_ = columns_type(store_, box(), bodies());  // columns move when memory is reserved
        near_.drop_kept_history(store_);
        is_started_ = false;  // if this throws, lists and columns may be of another step than particles
        Integrator::advance(*this, how_.time_step, count);
        near_.check_uses();
        is_started_ = true;
    }
    /// Particles take the history of their contacts into the field `contacts`: before they are written. Collective.
    /// @throws input_error on all ranks if particles were added or removed without change.
    void keep_history() {
        check_count("dem::run::keep_history");
        near_.keep_history(store_);
    }

    /// body(contact_pair<D>) for each contact of an owned particle; of those across a border each side has one.
    template <class Body>
    void each_contact(Body&& body) const {
        if constexpr (simulation_type::has_contacts)
            detail::each_contact<simulation_type>(at_, near_.pairs(), near_.near_walls(), near_.walls(), body);
    }
    /// body(i, j, spring): each spring from each side that is owned here.
    template <class Body>
    void each_spring(Body&& body) const {
        if constexpr (simulation_type::has_springs)
            for (const auto& [i, j, kind] : near_.springs())
                body(i, j, model<typename simulation_type::springs_type>().kinds[static_cast<std::size_t>(kind)]);
    }
    /// From particle j to i, the shorter way round on a lattice [m].
    [[nodiscard]] vec<D, double> apart(index_t i, index_t j) const noexcept {
        expect_columns();
        vec<D, double> d;
        for (std::size_t k = 0; k < D; ++k) d[k] = static_cast<double>(at_.apart(k, i, j));
        return d;
    }
    [[nodiscard]] double mass(index_t i) const noexcept {
        expect_columns();
        return static_cast<double>(at_.mass_at(i));
    }
    [[nodiscard]] double radius(index_t i) const noexcept {
        expect_columns();
        return static_cast<double>(at_.radius_at(i));
    }
    /// In real units [m].
    [[nodiscard]] vec<D, double> position(index_t i) const noexcept {
        expect_columns();
        return at_.real_position(i);
    }
    /// The acceleration of every particle [m/s^2]; zeros in a scene without gravity.
    [[nodiscard]] const vec<D, double>& gravity_acceleration() const noexcept { return gravity_; }

    // What integrators are made of. Durations in seconds.

    /// v += duration a.
    void kick(double duration) noexcept { mover().kick(duration); }
    /// x += duration v.
    void drift(double duration) noexcept { travel(mover().drift(duration), duration); }
    /// A kick, or two of them, and a drift, in one pass; forces are cleared.
    template <bool Twice>
    void kick_and_drift(double kicked, double drifted) noexcept {
        travel(mover().template kick_and_drift<Twice>(kicked, drifted), drifted);
    }
    /// x += step(i), for each owned particle.
    template <class Step>
    void displace(Step&& step) {
        travel(mover().displace(step), 1);
    }
    void clear_forces() noexcept { mover().clear_forces(); }
    [[nodiscard]] vec<D, real> acceleration(std::size_t i) const noexcept { return mover().acceleration(i); }
    /// The forces of all particles where they are, to be called after positions have changed; forces were cleared.
    void evaluate_forces() {
        forces_are_old_ = false;
        columns_hold_ = false;  // if that fails, particles may be elsewhere
        const bool is_new = near_.follow(store_);
        columns_hold_ = true;
        counted_ = store_.size();
        if (is_new) at_ = columns_type(store_, box(), bodies());
        find_forces(how_.time_step, [&] {
            if (!is_new) near_.finish(store_);
        });
    }
    void end_step() {
        ++steps_;
        if (how_.guard.every == 0 || steps_ % how_.guard.every != 0) return;
        if (forces_are_old_) {  // of an integrator that ends with a drift: ghosts are where they were before it
            clear_forces();
            evaluate_forces();
        }
        look();
    }

private:
    using partners = detail::partners;
    using columns_type = detail::columns<simulation_type>;
    using bodies_type = typename simulation_type::bodies_type;

    run(const box_type& box, const options& how, Transport& on, const typename simulation_type::models_type& models)
        : how_(how),
          on_(&on),
          models_(models),
          near_(box, checked(how), on, bodies(), detail::walls_of<simulation_type>(models_),
                detail::spring_kinds_of<simulation_type>(models_)) {
        std::apply([](const auto&... one) { (one.check(), ...); }, models_);
        if constexpr (simulation_type::has_gravity)
            for (std::size_t k = 0; k < D; ++k)
                gravity_[k] = model<typename simulation_type::gravity_type>().acceleration[k];
    }
    static const options& checked(const options& how) {
        if (!(how.time_step > 0) || !tsubu::detail::is_finite(how.time_step))
            tsubu::detail::raise<input_error>("dem::run",
                                              "a time step of " + tsubu::detail::shown(how.time_step) + " s",
                                              "give a finite time above 0");
        return how;
    }
    [[nodiscard]] const bodies_type& bodies() const noexcept { return model<bodies_type>(); }
    [[nodiscard]] auto mover() const noexcept {
        return detail::motion<simulation_type>(at_, store_.owned_count(), gravity_);
    }
    void expect_columns() const noexcept {
        TSUBU_EXPECTS(columns_hold_, "dem::run: not started, or the last call threw; call start first");
    }
    void travel(real fastest_square, double duration) noexcept {
        forces_are_old_ = true;
        near_.travel(std::sqrt(static_cast<double>(fastest_square)) * std::abs(duration));
    }
    void begin(bool finds_forces) {
        is_started_ = false;
        columns_hold_ = false;
        has_been_at_rest_ = false;
        agreement<> all(on_->rank());
        store_.clear_ghosts();
        all.attempt([&] { detail::check_particles<simulation_type>(store_); });
        on_->reduce(all.words(), reduction::sum);
        all.settle("dem::run::start");
        refuse_duplicates();
        near_.renew(store_, typename simulation_type::restart_fields{}, partners_);
        counted_ = store_.size();
        at_ = columns_type(store_, box(), bodies());
        columns_hold_ = true;
        look();
        if (finds_forces) {
            clear_forces();
            find_forces(0, [] {});  // no time passes: what contacts remember stays
        }
        is_started_ = true;
        partners_ = partners::are_here;
    }
    /// Whether particles were added or removed without run::change. Collective.
    void check_count(const char* where) {
        agreement<> all(on_->rank());
        all.attempt([&] {
            if (store_.size() != counted_)
                tsubu::detail::raise<input_error>(where,
                                                  std::to_string(store_.size()) +
                                                      " particles and ghosts, where neighbours were found of " +
                                                      std::to_string(counted_),
                                                  "add and remove particles by run::change, or start again");
        });
        on_->reduce(all.words(), reduction::sum);
        all.settle(where);
    }
    void refuse_duplicates() {
        const auto twice = duplicate_ids(*on_, store_.owned()[tsubu::id]);
        if (twice.empty()) return;
        tsubu::detail::raise<input_error>("dem::run::start",
                                          "ids that more than one particle has: " + std::to_string(twice.total) +
                                              (twice.here.empty()
                                                   ? ""
                                                   : ", among them " + std::to_string(twice.here[0].id)),
                                          "give each particle its own: contacts are remembered by it");
    }
    void look() {
        detail::watcher<run> watching(*this);
        agreement<> all(on_->rank());
        all.attempt([&] { watching.check(steps_); });
        on_->reduce(all.words(), reduction::sum);
        all.settle("dem::run", "particles are at that step");
        watching.check_together(steps_, has_been_at_rest_);
    }
    /// @param finish  to be called before anything is read of ghosts
    template <class Finish>
    void find_forces(double time_step, Finish&& finish) {
        if constexpr (simulation_type::has_contacts) {
            const detail::contact_kernel<simulation_type> kernel(at_, model<typename simulation_type::contact_type>(),
                                                                 time_step);
            auto& history = near_.history();
            const auto pairs = near_.pairs();
            const auto inner = near_.inner_pairs();
            kernel.act_on_pairs(pairs.first(inner), history.pair_touches(), history.pair_history());
            finish();
            kernel.act_on_pairs(pairs.subspan(inner),
                                history.pair_touches() + (simulation_type::has_history ? inner : 0),
                                history.pair_history() + (simulation_type::has_history ? inner : 0));
            if constexpr (simulation_type::has_walls)
                kernel.act_on_walls(near_.near_walls(), near_.walls(), history.wall_touches(), history.wall_history());
        } else {
            finish();
        }
        each_spring([&](index_t i, index_t j, const spring& one) {
            const auto d = apart(i, j);
            double square = 0;
            for (std::size_t k = 0; k < D; ++k) square += d[k] * d[k];
            const double distance = std::sqrt(square);
            const double along = -one.k * (distance - one.length) / distance;
            for (std::size_t k = 0; k < D; ++k) at_.f[i][k] += static_cast<real>(along * d[k]);
        });
        if constexpr (Integrator::solves_damping) detail::solve_damping(*this, time_step / 2);
    }

    options how_;
    Transport* on_;
    typename simulation_type::models_type models_;
    vec<D, double> gravity_{};
    store_type store_;
    detail::neighborhood<simulation_type, Transport> near_;
    columns_type at_;
    std::uint64_t steps_ = 0;
    std::size_t counted_ = 0;  // particles and ghosts when neighbours were found
    bool forces_are_old_ = false;
    bool columns_hold_ = false;
    partners partners_ = partners::are_here;  // whether those of a history that particles bring have to be near
    bool has_been_at_rest_ = false;
    bool is_started_ = false;

    template <class Run>
    friend void detail::solve_damping(Run&, double);
};

/// A run of a scene, with the transport's type found out.
///
///     auto bed = tsubu::dem::make_run<scene>(box, {.time_step = 1e-4, .skin = 0.1}, on, law, gravity, grains);
///
/// @throws input_error as the constructor of run.
template <class Simulation, transport Transport, class... Models>
[[nodiscard]] run<Simulation, Transport> make_run(const typename Simulation::box_type& box, const options& how,
                                                  Transport& on, const Models&... models) {
    using expected = typename Simulation::models_type;
    constexpr bool fits = [] {
        if constexpr (sizeof...(Models) == std::tuple_size_v<expected>)
            return std::is_constructible_v<expected, const Models&...>;
        else
            return false;
    }();
    static_assert(fits, "give the parameters of each model of the scene, in the order of its type; and equal_spheres "
                        "last, where the type names neither them nor spheres");
    if constexpr (fits) return run<Simulation, Transport>(box, how, on, models...);
}

}  // namespace tsubu::dem

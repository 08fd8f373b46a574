// SPDX-License-Identifier: MIT
/// @file
/// write_restart and read_restart of a run: it stops, and goes on elsewhere.
#pragma once

#include <tsubu/comm/agreement.hpp>
#include <tsubu/comm/shared_restart.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/dem/run.hpp>
#include <tsubu/io/restart.hpp>
#include <tsubu/io/restart_state.hpp>

#include <cstdint>  // std::int64_t
#include <string>   // std::string

namespace tsubu::dem {

/// Writes what a run of the same scene needs to go on, on any number of ranks: particles with the histories of their
/// contacts, the box, and how many steps were done.
///
///     tsubu::dem::write_restart(bed, "bed.restart");
///
/// @param before  steps of the runs before this one: each counts from 0
/// @throws on all ranks or none: as keep_history and tsubu::write_restart. What was at `path` is as before then.
/// Collective: yes; the same path on all ranks.
template <class Run>
void write_restart(Run& of, const std::string& path, std::int64_t before = 0) {
    of.keep_history();
    tsubu::write_restart(of.on(), path, of.particles(), typename Run::simulation_type::restart_fields{},
                         {.step = before + static_cast<std::int64_t>(of.steps_done()), .box = restart_box(of.box())});
}

/// Reads what write_restart wrote into a run without particles, and begins it: it goes on as the other would have, to
/// rounding.
///
///     auto bed = tsubu::dem::make_run<scene>(box, how, on, law, gravity, grains);
///     const auto steps = tsubu::dem::read_restart(bed, "bed.restart").step;
///
/// @throws on all ranks or none: input_error if the run has particles, or another box than the file; as
///         tsubu::read_restart and resume.
/// Collective: yes; the same path on all ranks.
template <class Run>
restart_state read_restart(Run& into, const std::string& path) {
    using simulation = typename Run::simulation_type;
    constexpr auto where = "dem::read_restart";
    agreement<> all(into.on().rank());
    all.attempt([&] {
        if (!into.particles().empty())
            tsubu::detail::raise<input_error>(where, "the run has particles already",
                                              "read into one that was just made");
        if (restart_reader(path).state().box != restart_box(into.box()))
            tsubu::detail::raise<input_error>(
                where, path + " is of another box",
                "make the run with restart_reader(path).state().box, or read the particles "
                "alone by tsubu::read_restart");
    });
    into.on().reduce(all.words(), reduction::sum);
    all.settle(where, "the run is as it was");
    auto state = tsubu::read_restart(into.on(), path, into.particles(), typename simulation::restart_fields{},
                                     typename simulation::decomposition_type(into.box(), into.on().ranks()));
    into.resume();
    return state;
}

}  // namespace tsubu::dem

// SPDX-License-Identifier: MIT
/// @file
/// write_restart and read_restart of all ranks together: one file, for any number of ranks.
#pragma once

#include <tsubu/comm/agreement.hpp>
#include <tsubu/comm/detail/rows.hpp>
#include <tsubu/comm/migrate.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/domain/concepts.hpp>
#include <tsubu/io/atomic_file.hpp>
#include <tsubu/io/restart.hpp>
#include <tsubu/io/restart_state.hpp>
#include <tsubu/store/field.hpp>

#include <array>     // std::array
#include <cstdint>   // std::uint64_t
#include <optional>  // std::optional
#include <string>    // std::string
#include <vector>    // std::vector

namespace tsubu {

/// Writes these fields of the owned particles of all ranks to one file, which is there whole or not at all.
///
///     tsubu::write_restart(on, "run.restart", grains, set, {.step = step, .box = tsubu::restart_box(box)});
///
/// @param path  on a file system that all ranks see
/// @throws on all ranks or none: file_error, input_error as write_restart of one rank; on ranks that were not the ones
///         to fail, what agreement says of them. What was at `path` is as before then.
/// Collective: yes; the same path, set and state on all ranks. Two gathers of a few words, four reductions.
template <transport Transport, auto... F, class Store>
void write_restart(Transport& on, const std::string& path, const Store& store, fields<F...> set,
                   const restart_state& state = {}) {
    constexpr auto where = "write_restart";
    const auto together = [&](auto&& work) {
        agreement<> all(on.rank());
        all.attempt(work);
        on.reduce(all.words(), reduction::sum);
        all.settle(where);
    };
    restart_part mine;
    together([&] { mine = restart_part_of(store, set); });
    const std::array<std::uint64_t, 3> numbers{mine.particles, mine.blocks, mine.bytes};
    std::vector<restart_part> parts;
    for (const auto& [rank, told] : on.gather(numbers)) parts.push_back({told[0], told[1], told[2]});
    const restart_plan plan(set, state, parts);

    std::optional<atomic_file> file;  // of rank 0; the others write into it by its name until it is committed
    std::vector<std::uint64_t> name;  // a word per character, from rank 0
    together([&] {
        if (on.rank() != 0) return;
        file.emplace(path);
        plan.write_header(file->writer());
        const auto& text = file->temporary_path();
        name.assign(text.begin(), text.end());
    });
    std::string temporary_path;
    const auto told = on.gather(name);
    for (const auto c : told[0].words) temporary_path += static_cast<char>(c);
    together([&] {
        file_writer part(temporary_path);
        plan.write_part(part, on.rank(), store, set);
        part.close();
    });
    together([&] {
        if (file) plan.commit(*file);
    });
}

/// Adds the particles of a restart file to the ranks that own their positions, whatever number of ranks has written it.
///
///     const auto state = tsubu::read_restart(on, "run.restart", grains, set, bricks);
///
/// Each rank reads a share of the file, and sends what is not its own; no rank holds more than its share and what it
/// owns.
/// @param set  fields of the file, the position among them
/// @throws on all ranks or none: as restart_reader and migrate; the store holds then what it held, wrapped.
/// Collective: yes; the same path, set and decomposition on all ranks.
template <transport Transport, auto... F, class Store, decomposition Parts>
restart_state read_restart(Transport& on, const std::string& path, Store& store, fields<F...> set, const Parts& parts) {
    restart_state state;
    const auto before = store.owned_count();
    agreement<> all(on.rank());
    all.attempt([&] {
        const restart_reader file(path);
        file.read(store, set, every_particle{}, {.rank = on.rank(), .ranks = on.ranks()});
        state = file.state();
    });
    on.reduce(all.words(), reduction::sum);
    if (all.has_failed()) detail::drop_rows(store, before);
    all.settle("read_restart");
    migrate(store, parts, on);
    return state;
}

}  // namespace tsubu

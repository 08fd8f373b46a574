// SPDX-License-Identifier: MIT
/// @file
/// write_restart and read_restart of all ranks together: one file, for any number of ranks.
#pragma once

#include <tsubu/comm/detail/agreed.hpp>
#include <tsubu/comm/detail/rank_checks.hpp>
#include <tsubu/comm/detail/rows.hpp>
#include <tsubu/comm/mailbox.hpp>
#include <tsubu/comm/migrate.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/domain/concepts.hpp>
#include <tsubu/io/atomic_file.hpp>
#include <tsubu/io/checksum.hpp>
#include <tsubu/io/every_particle.hpp>
#include <tsubu/io/restart.hpp>
#include <tsubu/io/restart_state.hpp>
#include <tsubu/store/field.hpp>

#include <array>     // std::array
#include <cstdint>   // std::uint64_t
#include <optional>  // std::optional
#include <span>      // std::as_bytes, std::span
#include <string>    // std::string, std::to_string
#include <utility>   // std::move
#include <vector>    // std::vector

namespace tsubu {
namespace detail {

/// Differs if the states do, but for one in 2^64.
[[nodiscard]] inline std::uint64_t checksum_of(const restart_state& state) noexcept {
    crc64 sum;
    const auto add = [&](const auto& numbers) { sum.add(std::as_bytes(std::span(numbers))); };
    const auto& box = state.box;
    const auto periodic = (box.periodic[0] ? 1U : 0U) | (box.periodic[1] ? 2U : 0U) | (box.periodic[2] ? 4U : 0U);
    add(std::array{static_cast<std::uint64_t>(state.step), std::uint64_t{box.dimension}, std::uint64_t{periodic}});
    for (const auto* numbers : {&box.lo, &box.hi, &box.lengths, &box.tilts}) add(*numbers);
    add(state.words);
    return sum.value();
}

}  // namespace detail

/// Writes these fields of the owned particles of all ranks to one file, which is there whole or not at all.
///
///     tsubu::write_restart(on, "run.restart", grains, set, {.step = step, .box = tsubu::restart_box(box)});
///
/// @param path  on a file system that all ranks see
/// @throws on all ranks or none: file_error, input_error as write_restart of one rank; input_error if the state is not
///         the same on all; on ranks that were not the ones to fail, what agreement says of them. What was at `path` is
///         as before then.
/// Collective: yes; the same path, set and state on all ranks. Two gathers of a few words, six reductions.
template <transport Transport, auto... F, class Store>
void write_restart(Transport& on, const std::string& path, const Store& store, fields<F...> set,
                   const restart_state& state = {}) {
    constexpr auto where = "write_restart";
    std::array<std::uint64_t, 4> numbers{};
    detail::agreed(on, where, [&] {
        const auto mine = restart_part_of(store, set);
        numbers = {mine.particles, mine.blocks, mine.bytes, detail::checksum_of(state)};
    });
    std::optional<restart_plan> plan;
    detail::agreed_gather(on, where, numbers, [&](const mailbox& came) {
        std::vector<restart_part> parts;
        for (const auto& [rank, told] : came) {
            if (told[3] != came[0].words[3])
                detail::raise<input_error>(where,
                                           "the state on rank " + std::to_string(rank) + " is not that on rank 0",
                                           "give the same on all ranks; what differs belongs into a field");
            parts.push_back({told[0], told[1], told[2]});
        }
        plan.emplace(set, state, std::move(parts));
    });

    std::optional<atomic_file> file;  // of rank 0; the others write into it by its name until it is committed
    std::vector<std::uint64_t> name;  // a word per character, from rank 0
    detail::agreed(on, where, [&] {
        if (on.rank() != 0) return;
        file.emplace(path);
        plan->write_header(file->writer());
        const auto& text = file->temporary_path();
        name.assign(text.begin(), text.end());
    });
    std::string temporary_path;
    detail::agreed_gather(on, where, name, [&](const mailbox& came) {
        for (const auto c : came[0].words) temporary_path += static_cast<char>(c);
    });
    detail::agreed(on, where, [&] {
        file_writer part(temporary_path);
        plan->write_part(part, on.rank(), store, set);
        part.close();
    });
    detail::agreed(on, where, [&] {
        if (file) plan->commit(*file);
    });
}

/// Adds the particles of a restart file to the ranks that own their positions, whatever number of ranks has written it.
///
///     const auto state = tsubu::read_restart(on, "run.restart", grains, set, bricks);
///
/// Each rank reads a share of the file, and sends what is not its own; no rank holds more than its share and what it
/// owns. The box may be another than that of the file; to go on in the same one:
///
///     const auto box = tsubu::restart_reader("run.restart").state().box.as<tsubu::domain<3>>();
///
/// @param set  fields of the file, the position among them
/// @throws on all ranks or none: as restart_reader and migrate; the store holds then what it held, wrapped.
/// Collective: yes; the same path, set and decomposition on all ranks. One reduction, and migrate.
template <transport Transport, auto... F, class Store, decomposition Parts>
restart_state read_restart(Transport& on, const std::string& path, Store& store, fields<F...> set, const Parts& parts) {
    constexpr auto where = "read_restart";
    restart_state state;
    const auto before = store.owned_count();
    try {
        detail::agreed(on, where, [&] {
            detail::check_ranks(where, parts.ranks(), on.ranks());
            const restart_reader file(path);
            file.read(store, set, every_particle{}, {.rank = on.rank(), .ranks = on.ranks()});
            state = file.state();
        });
        migrate(store, parts, on);
    } catch (...) {
        detail::drop_rows(store, before);
        throw;
    }
    return state;
}

}  // namespace tsubu

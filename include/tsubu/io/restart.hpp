// SPDX-License-Identifier: MIT
/// @file
/// write_restart and read_restart: the particles of a run, bit for bit, to go on with later.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/expects.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/io/atomic_file.hpp>
#include <tsubu/io/byte_source.hpp>
#include <tsubu/io/checksum.hpp>
#include <tsubu/io/detail/restart_format.hpp>
#include <tsubu/io/every_particle.hpp>
#include <tsubu/io/restart_state.hpp>
#include <tsubu/store/field.hpp>
#include <tsubu/store/growth.hpp>
#include <tsubu/store/pack.hpp>
#include <tsubu/store/particle_store.hpp>

#include <algorithm>    // std::min
#include <array>        // std::array
#include <cstddef>      // std::byte, std::size_t, std::to_integer
#include <cstdint>      // std::uint64_t
#include <cstring>      // std::memcpy
#include <new>          // std::bad_alloc
#include <numeric>      // std::iota
#include <span>         // std::as_bytes, std::span
#include <string>       // std::string, std::to_string
#include <type_traits>  // std::is_same_v, std::remove_cv_t
#include <utility>      // std::as_const, std::move
#include <vector>       // std::vector

namespace tsubu {
namespace detail {

inline void check_block(const char* where, std::size_t particles_per_block) {
    if (particles_per_block == 0) raise<input_error>(where, "blocks of no particle", "give at least 1");
}
/// bool, or an array of it.
template <class Value>
inline constexpr bool is_made_of_bools = std::is_same_v<Value, bool>;
template <class Element, std::size_t N>
inline constexpr bool is_made_of_bools<std::array<Element, N>> = is_made_of_bools<Element>;
/// Calls body(indices) for the owned particles of a store, some at a time.
template <class Store, class Body>
void each_block_of(const Store& store, std::size_t particles_per_block, Body&& body) {
    std::vector<index_t> chosen;
    for (std::size_t first = 0; first < store.owned_count(); first += chosen.size()) {
        chosen.resize((std::min)(particles_per_block, store.owned_count() - first));
        std::iota(chosen.begin(), chosen.end(), static_cast<index_t>(first));
        body(std::span<const index_t>(chosen));
    }
}

}  // namespace detail

/// What a restart file of several ranks will look like; the same on all ranks, who then write their parts in any order.
///
///     // every rank:
///     const auto mine = tsubu::restart_part_of(g, set);              // then gather: parts, in the order of ranks
///     tsubu::restart_plan plan(set, state, parts);
///     // rank 0:                                                     // then tell file.temporary_path() to all
///     tsubu::atomic_file file("run.restart");
///     plan.write_header(file.writer());
///     // every rank:
///     tsubu::file_writer part(temporary_path);
///     plan.write_part(part, rank, g, set);
///     part.close();
///     // rank 0, when all have:
///     plan.commit(file);
///
/// What is equal on all ranks: the set, the state, the parts. Threads: any number of readers.
class restart_plan {
public:
    /// @param parts  what restart_part_of says, of rank 0, 1, ..., for as many particles per block
    /// @throws input_error if there are no particles per block.
    template <auto... F>
    restart_plan(fields<F...> set, const restart_state& state, std::vector<restart_part> parts,
                 std::size_t particles_per_block = store_block) {
        static_assert(sizeof...(F) > 0, "a restart file needs a field");
        detail::check_block("restart_plan", particles_per_block);
        header_.state = state;
        header_.particles_per_block = particles_per_block;
        header_.fields = detail::restart_fields(set);
        header_.parts = std::move(parts);
        words_ = detail::encode(header_);
    }
    /// Of the whole file.
    [[nodiscard]] std::uint64_t bytes() const noexcept { return header_.bytes; }
    /// Where the part of a rank begins.
    [[nodiscard]] std::uint64_t offset(std::size_t rank) const noexcept {
        auto at = detail::word_bytes * header_.words;
        for (std::size_t k = 0; k < rank; ++k) at += header_.parts[k].bytes;
        return at;
    }
    /// @throws file_error
    void write_header(file_writer& file) const { file.write_at(0, std::as_bytes(std::span(words_))); }
    /// Writes the owned particles of a rank into its part. Memory: one block. @throws file_error; input_error if they
    /// are not those that the plan was made for.
    template <auto... F, class Store>
    void write_part(file_writer& file, std::size_t rank, const Store& store, fields<F...> set) const {
        if (rank >= header_.parts.size() || header_.parts[rank].particles != store.owned_count() ||
            detail::restart_fields(set) != header_.fields)
            refuse(rank);
        const auto begin = offset(rank);
        auto at = begin;
        std::uint64_t block = 0;
        buffer<std::uint64_t> words;
        detail::each_block_of(store, particles_per_block(), [&](std::span<const index_t> chosen) {
            constexpr auto head = detail::restart_block_header;
            const auto body = packed_words(store, set, chosen);
            if (head + body > words.size()) words = buffer<std::uint64_t>(head + body, {});
            const std::span<std::uint64_t> all(words.data(), head + body);
            pack(store, set, chosen, all.subspan(head));
            detail::restart_block label;
            label.part = rank;
            label.number = block++;
            label.particles = chosen.size();
            label.words = body;
            label.body_checksum = crc64_of(all.subspan(head));
            label.file_checksum = header_.checksum;
            label.checksum = label.own_checksum();
            std::memcpy(all.data(), &label, sizeof(label));
            if (at - begin + all.size_bytes() > header_.parts[rank].bytes) refuse(rank);  // never over another's part
            file.write_at(at, std::as_bytes(all));
            at += all.size_bytes();
        });
        if (at - begin != header_.parts[rank].bytes) refuse(rank);
    }
    /// Gives the file its name, if it is as long as it must be. @throws file_error, input_error
    void commit(atomic_file& file) const {
        if (file.writer().size() != bytes())
            detail::raise<input_error>("restart_plan::commit",
                                       file.path() + " has " + std::to_string(file.writer().size()) + " bytes of " +
                                           std::to_string(bytes()),
                                       "write the parts of all ranks first");
        file.commit();
    }

private:
    [[nodiscard]] std::size_t particles_per_block() const noexcept {
        return static_cast<std::size_t>(header_.particles_per_block);
    }
    [[noreturn]] static void refuse(std::size_t rank) {
        detail::raise<input_error>("restart_plan::write_part",
                                   "the particles or fields of rank " + std::to_string(rank) +
                                       " are not those of the plan",
                                   "plan and write without a change of the store in between");
    }

    detail::restart_header header_;
    std::vector<std::uint64_t> words_;
};

/// How large the part of this rank in a restart file is: of its owned particles. O(1) words; O(n) if there are lists.
/// @throws input_error if there are no particles per block.
template <auto... F, class Store>
[[nodiscard]] restart_part restart_part_of(const Store& store, fields<F...> set,
                                           std::size_t particles_per_block = store_block) {
    detail::check_block("restart_part_of", particles_per_block);
    restart_part part;
    part.particles = store.owned_count();
    detail::each_block_of(store, particles_per_block, [&](std::span<const index_t> chosen) {
        ++part.blocks;
        part.bytes += detail::word_bytes * (detail::restart_block_header + packed_words(store, set, chosen));
    });
    return part;
}

/// Writes these fields of the owned particles of one rank; for several ranks see restart_plan.
///
///     using set = tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::velocity<3>>;
///     tsubu::write_restart("run.restart", g, set{}, {.step = 1000, .box = tsubu::restart_box(box)});
///
/// Memory: one block. The file is there whole or not at all: see atomic_file.
/// @throws file_error if the folder does not exist, the disk is full, ...; nothing is left then.
template <auto... F, class Store>
void write_restart(const std::string& path, const Store& store, fields<F...> set, const restart_state& state = {}) {
    const restart_plan plan(set, state, {restart_part_of(store, set)});
    atomic_file file(path);
    plan.write_header(file.writer());
    plan.write_part(file.writer(), 0, store, set);
    plan.commit(file);
}

/// For restart_reader::read: every ranks-th block, from block `rank` on.
struct restart_share {
    std::uint64_t rank = 0;
    std::uint64_t ranks = 1;
};

/// What is in this restart file?
///
///     tsubu::restart_reader file("run.restart");
///     const auto box = file.state().box.as<tsubu::domain<3>>();
///     file.read(g, set{}, [&](const auto& particle) { return mine.contains(particle[tsubu::position<3>]); });
///
/// Any number of ranks may read, whatever number has written: each keeps what is its own, or takes a share of the
/// blocks and migrates after. A file that is damaged, not whole, longer, foreign, of another version or byte order is
/// refused, with its name, the place and the reason.
///
/// @tparam Source  a byte_source.
/// Threads: any number of readers, into different stores.
template <byte_source Source = file_source>
class restart_reader {
public:
    /// Reads and checks the header. @throws file_error; input_error if it is not as it must be.
    explicit restart_reader(Source source) : source_(std::move(source)), header_(detail::decode(source_)) {}
    explicit restart_reader(std::string path)
        requires std::is_same_v<Source, file_source>
        : restart_reader(file_source(std::move(path))) {}

    [[nodiscard]] const restart_state& state() const noexcept { return header_.state; }
    /// What the file holds of each particle, whether or not it is read.
    [[nodiscard]] std::span<const restart_field> fields_in_file() const noexcept { return header_.fields; }
    /// One for each rank that has written.
    [[nodiscard]] std::span<const restart_part> parts() const noexcept { return header_.parts; }
    /// Of all parts.
    [[nodiscard]] std::uint64_t count() const noexcept {
        std::uint64_t particles = 0;
        for (const auto& part : header_.parts) particles += part.particles;
        return particles;
    }

    /// Adds the particles for which keep(particle) holds as owned ones; fields that are not in the set are zero. The
    /// set may be some of the fields of the file, in any order: what is not asked for is checked, and passed over.
    /// Memory: what is kept, and one block. Strong guarantee; views end in any case.
    /// @param set    fields of the file: of its names, types and units
    /// @param share  which blocks; others are not read
    /// @throws input_error if the file lacks a field or is damaged, or the store has ghosts; limit_error from 2^31
    ///         particles on; file_error if the disk fails.
    template <auto... F, class Store, class Keep = every_particle>
    void read(Store& store, fields<F...> set, Keep&& keep = {}, restart_share share = {}) const {
        static_assert(sizeof...(F) > 0, "ask for a field of the file");
        const auto wanted = detail::restart_fields(set);
        detail::check_fields(source_.name(), header_.fields, wanted);
        if (share.ranks == 0 || share.rank >= share.ranks)
            detail::raise<input_error>("restart_reader::read",
                                       "share " + std::to_string(share.rank) + " of " + std::to_string(share.ranks),
                                       "shares go from 0 to ranks - 1");
        const auto before = store.size();
        store.add_owned(0);  // refuses ghosts, before any work
        try {
            if (header_.fields == wanted)
                read_parts(store, set, keep, share, nullptr);
            else if (const detail::restart_layout layout(header_.fields, wanted); true)
                read_parts(store, set, keep, share, &layout);
        } catch (...) {
            drop(store, before);
            throw;
        }
    }

private:
    /// Of a block.
    struct place {
        std::uint64_t byte;
        std::uint64_t part;
        std::uint64_t block;
    };

    template <auto... F, class Store, class Keep>
    void read_parts(Store& store, fields<F...> set, Keep& keep, restart_share share,
                    const detail::restart_layout* layout) const {
        particle_store<fields<F...>> met;  // one block
        buffer<std::uint64_t> words;
        std::vector<std::uint64_t> chosen;
        const auto least = layout == nullptr ? std::uint64_t{detail::packer<fields<F...>>::least} : layout->least();
        std::uint64_t next = 0;
        auto at = detail::word_bytes * header_.words;
        for (std::size_t p = 0; p < header_.parts.size(); ++p) {
            const auto& part = header_.parts[p];
            const auto end = at + part.bytes;
            std::uint64_t particles = 0;
            for (std::uint64_t b = 0; b < part.blocks; ++b) {
                const place here{at, p, b};
                const auto block = read_header(here, end, least);
                particles += block.particles;
                at += sizeof(block);
                if (next++ % share.ranks == share.rank) {
                    const auto count = static_cast<std::size_t>(block.particles);
                    auto body = read_body(here, block, words);
                    if (layout != nullptr) {
                        chosen.clear();
                        const auto used = layout->choose(body, count, chosen);
                        if (!used) refuse(here, "its words end too early");
                        if (*used != body.size()) refuse(here, "it has more words than its particles");
                        body = chosen;
                    }
                    take(store, set, keep, met, body, count, here);
                }
                at += detail::word_bytes * block.words;
            }
            if (at != end || particles != part.particles)
                detail::refuse_restart(source_.name(), at,
                                       "part " + std::to_string(p) + " is not what the header says");
        }
    }
    [[nodiscard]] detail::restart_block read_header(const place& here, std::uint64_t end, std::uint64_t least) const {
        detail::restart_block block;
        if (end - here.byte < sizeof(block)) refuse(here, "it does not fit its part");
        source_.read(here.byte, std::as_writable_bytes(std::span(&block, 1)));
        if (block.magic != detail::restart_block_magic) refuse(here, "no block begins here");
        if (block.own_checksum() != block.checksum) refuse(here, "the checksum of its header differs");
        if (block.part != here.part || block.number != here.block || block.file_checksum != header_.checksum)
            refuse(here, "a block of another place or file lies here");
        if (block.words > (end - here.byte - sizeof(block)) / detail::word_bytes ||
            block.particles > header_.particles_per_block || block.particles > block.words / least)
            refuse(here, std::to_string(block.particles) + " particles in " + std::to_string(block.words) +
                             " words cannot be");
        return block;
    }
    [[nodiscard]] std::span<const std::uint64_t> read_body(const place& here, const detail::restart_block& block,
                                                           buffer<std::uint64_t>& words) const {
        const auto count = static_cast<std::size_t>(block.words);
        if (count > words.size()) words = buffer<std::uint64_t>(count, {});
        const std::span<std::uint64_t> body(words.data(), count);
        source_.read(here.byte + sizeof(block), std::as_writable_bytes(body));
        if (crc64_of(body) != block.body_checksum) refuse(here, "the checksum of its particles differs");
        return body;
    }
    template <auto... F, class Store, class Keep>
    void take(Store& store, fields<F...> set, Keep& keep, particle_store<fields<F...>>& met,
              std::span<const std::uint64_t> words, std::size_t count, const place& here) const {
        if constexpr (std::is_same_v<std::remove_cv_t<Keep>, every_particle>) {
            add(store, set, words, count, here);
        } else {
            met.clear();
            add(met, set, words, count, here);
            std::vector<index_t> chosen;
            for (const auto particle : std::as_const(met).owned())
                if (keep(particle)) chosen.push_back(static_cast<index_t>(particle.index()));
            if (chosen.size() == count) return add(store, set, words, count, here);
            std::vector<std::uint64_t> kept(packed_words(met, set, chosen));
            pack(met, set, chosen, kept);
            add(store, set, kept, chosen.size(), here);
        }
    }
    template <auto... F, class Store>
    void add(Store& store, fields<F...> set, std::span<const std::uint64_t> words, std::size_t count,
             const place& here) const {
        const auto first = store.add_owned(count);
        std::size_t taken = 0;
        try {
            taken = unpack(store, set, first, count, words);
        } catch (const input_error&) {
            refuse(here, "its words end too early");
        }
        if (taken != words.size()) refuse(here, "it has more words than its particles");
        bool sound = true;
        ((sound = sound && has_sound_bools<std::remove_cv_t<decltype(F)>>(store, first)), ...);
        if (!sound) refuse(here, "a bool that is neither true nor false");
    }
    /// To look at a bool that is neither is undefined.
    template <class Field, class Store>
    [[nodiscard]] static bool has_sound_bools(Store& store, std::size_t first) {
        bool sound = true;
        if constexpr (detail::is_made_of_bools<typename Field::value_type>) {
            const auto column = store[Field{}];
            for (std::size_t i = first; i < store.size(); ++i)
                for (const auto byte : std::as_bytes(std::span(&column[i], 1)))
                    sound = sound && std::to_integer<unsigned>(byte) <= 1;
        }
        return sound;
    }
    template <class Store>
    static void drop(Store& store, std::size_t count) noexcept {
        while (store.size() > count) {
            try {
                store.swap_remove(store.size() - 1);
            } catch (const std::bad_alloc&) {  // of the compaction of lists, after the particle went
            }
        }
    }
    [[noreturn]] void refuse(const place& here, const std::string& reason) const {
        detail::refuse_restart(source_.name(), here.byte,
                               "block " + std::to_string(here.block) + " of part " + std::to_string(here.part) + ": " +
                                   reason);
    }

    Source source_;
    detail::restart_header header_;
};
restart_reader(std::string) -> restart_reader<file_source>;
restart_reader(const char*) -> restart_reader<file_source>;

/// Adds the particles of a file as owned ones; what else it holds. See restart_reader.
template <auto... F, class Store>
restart_state read_restart(const std::string& path, Store& store, fields<F...> set) {
    const restart_reader file(path);
    file.read(store, set);
    return file.state();
}

}  // namespace tsubu

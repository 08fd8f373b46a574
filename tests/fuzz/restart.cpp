// SPDX-License-Identifier: MIT
// What does the reader of restart files do with bytes that nobody has written? Built with -fsanitize=fuzzer.
//
// The first byte of an input says how it is meant. Even: the rest is the file. Odd: the rest are changes of a file that
// was written, ten bytes each: which word, and its new value; whole words are what counts consist of. Bit 1: checksums,
// marks and the length are mended first, or none of the code behind them would be reached.
#include <tsubu/io/restart.hpp>

#include <tsubu/store/standard_fields.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace {

struct contact {
    std::int64_t with;
    std::int32_t age;
};
inline constexpr tsubu::field<"contacts", tsubu::list_of<contact>> contacts{};
inline constexpr tsubu::field<"frozen", bool> frozen{};
inline constexpr tsubu::field<"shape", tsubu::bonus_of<std::array<float, 3>>> shape{};
using set = tsubu::fields<tsubu::id, tsubu::position<2>, frozen, contacts, shape>;
using store = tsubu::particle_store<set>;
using words = std::vector<std::uint64_t>;

constexpr std::size_t head = tsubu::detail::restart_block_header;

/// Two parts, of blocks of two particles.
words written_file() {
    std::vector<store> ranks(2);
    std::vector<tsubu::restart_part> parts;
    for (std::size_t r = 0; r < 2; ++r) {
        for (int i = 0; i < 3; ++i) {
            const auto at = static_cast<std::size_t>(ranks[r].push_back(tsubu::id = i, frozen = i == 1));
            for (int k = 0; k < i; ++k) ranks[r][contacts][at].push_back({k, i});
            if (i == 2) ranks[r][shape][at].emplace({1, 2, 3});
        }
        parts.push_back(tsubu::restart_part_of(ranks[r], set{}, 2));
    }
    const tsubu::restart_plan plan(set{}, {.step = 3, .box = {}, .words = {1, 2}}, parts, 2);
    tsubu::atomic_file file((std::filesystem::temp_directory_path() / "tsubu_fuzz.restart").string());
    plan.write_header(file.writer());
    for (std::size_t r = 0; r < 2; ++r) plan.write_part(file.writer(), r, ranks[r], set{});
    words bytes(plan.bytes() / 8);
    tsubu::file_source(file.temporary_path()).read(0, std::as_writable_bytes(std::span(bytes)));
    return bytes;  // the file goes with its object
}

/// Marks, length and checksums become right, as far as the lengths in the file lead to them.
void mend(words& file) {
    if (file.size() < 6) return;
    file[0] = tsubu::detail::restart_magic;
    file[1] = tsubu::detail::restart_byte_order;
    file[2] = tsubu::detail::restart_version;
    file[4] = 8 * file.size();
    const auto end = file[3];
    if (end <= 5 || end > file.size()) return;
    const std::span<std::uint64_t> all(file);
    const auto link = file[end - 1] = tsubu::crc64_of(all.first(end - 1));
    for (auto at = static_cast<std::size_t>(end); file.size() - at >= head;) {
        const auto block = all.subspan(at);
        if (block[4] > block.size() - head) block[4] = block.size() - head;
        block[0] = tsubu::detail::restart_block_magic;
        block[5] = tsubu::crc64_of(block.subspan(head, block[4]));
        block[6] = link;
        block[7] = tsubu::crc64_of(block.first(7));
        at += head + block[4];
    }
}

void require(bool holds) {
    if (!holds) std::abort();
}

template <class Keep>
void read(std::span<const std::byte> file, Keep keep) {
    store g;
    g.push_back(tsubu::id = 5);
    try {
        const tsubu::restart_reader reader(tsubu::memory_source(file, "fuzzed"));
        reader.read(g, set{}, keep);
        require(g.owned_count() <= 1 + reader.count());
        // Whatever came can be used.
        std::size_t elements = 0;
        for (std::size_t i = 0; i < g.size(); ++i) {
            elements += g[contacts][i].size() + (g[frozen][i] ? 1 : 0);
            for (const auto& one : g[contacts][i]) elements += one.age == 7 ? 1U : 0U;
        }
        for (const auto& one : g[shape].values()) elements += one[0] > 0 ? 1U : 0U;
        require(elements <= 2 * file.size());
    } catch (const tsubu::error&) {
        require(g.owned_count() == 1 && g.size() == 1 && g[tsubu::id][0] == 5);
    }
}

/// Some of the fields, in another order; what is passed over is not looked at, but its length is.
void read_some(std::span<const std::byte> file) {
    using some = tsubu::fields<shape, tsubu::id, contacts>;
    tsubu::particle_store<some> g;
    try {
        const tsubu::restart_reader reader(tsubu::memory_source(file, "fuzzed"));
        reader.read(g, some{});
        require(g.owned_count() <= reader.count());
        std::size_t elements = 0;
        for (std::size_t i = 0; i < g.size(); ++i) elements += g[contacts][i].size();
        require(elements <= 2 * file.size());
    } catch (const tsubu::error&) {
        require(g.size() == 0);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* input, std::size_t size) {
    static const words valid = written_file();
    if (size == 0) return 0;
    const auto how = *input++;
    --size;
    words file;
    std::size_t odd_bytes = 0;
    if (how % 2 == 0) {
        file.resize(size / 8 + 1);
        std::memcpy(file.data(), input, size);
        odd_bytes = file.size() * 8 - size;
    } else {
        file = valid;
        for (; size >= 10; size -= 10, input += 10) {
            std::uint16_t where = 0;
            std::memcpy(&where, input, 2);
            if (where >= 0xFF00) {
                file.resize(
                    (std::min)(file.size() + 16, std::size_t{where} - 0xFF00 + 6));  // shorter, or a little longer
            } else {
                std::memcpy(&file[where % file.size()], input + 2, 8);
            }
        }
    }
    if ((how & 2) != 0) {
        mend(file);
        odd_bytes = 0;
    }
    const auto bytes = std::as_bytes(std::span(file)).first(file.size() * 8 - odd_bytes);
    read(bytes, tsubu::every_particle{});
    read(bytes, [](const auto& particle) { return particle[tsubu::id] % 2 == 0; });
    read_some(bytes);
    return 0;
}

// SPDX-License-Identifier: MIT
#include <tsubu/io/restart.hpp>

#include "support/catch.hpp"
#include "unit/io/scratch_folder.hpp"
#include "unit/thrown.hpp"

#include <tsubu/core/random.hpp>
#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/triclinic_box.hpp>
#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <sys/resource.h>

using tsubu::file_error;
using tsubu::input_error;
using tsubu::memory_source;
using tsubu::restart_part;
using tsubu::restart_plan;
using tsubu::restart_reader;
using tsubu::restart_state;

namespace {

struct contact {
    std::int64_t with;
    float history[3];
    std::int32_t age;
};
inline constexpr tsubu::field<"contacts", tsubu::list_of<contact>> contacts{};
inline constexpr tsubu::field<"colours", tsubu::list_of<unsigned char>> colours{};
inline constexpr tsubu::field<"shape", tsubu::bonus_of<std::array<float, 3>>> shape{};
inline constexpr tsubu::field<"frozen", bool> frozen{};
inline constexpr tsubu::field<"charge", float, "C"> charge{};
inline constexpr tsubu::field<"temperature", double, "K"> temperature{};

using set = tsubu::fields<tsubu::id, tsubu::position<3>, frozen, charge, contacts, tsubu::radius, colours, shape>;
template <class Layout = tsubu::soa>
using grains = tsubu::particle_store<set, Layout>;

/// Particles with all that text or arithmetic would change.
template <class Store>
void add_particles(Store& g, int first, int count) {
    for (int i = first; i < first + count; ++i) {
        const auto at = static_cast<std::size_t>(
            g.push_back(tsubu::id = (std::int64_t{1} << 53) + 1 + 2 * i,
                        tsubu::position<3> = {std::bit_cast<double>(0x7FF0000000000001 + static_cast<std::uint64_t>(i)),
                                              -0.0, i * 5e-324},
                        frozen = i % 3 == 0, charge = std::bit_cast<float>(0x7F800001 + i),
                        tsubu::radius = i % 2 == 0 ? std::numeric_limits<double>::max() : 0.1 + i));
        for (int k = 0; k < i % 4; ++k) g[contacts][at].push_back({-i, {0.1F, -0.0F, 1e-45F}, k});
        if (i % 5 == 2) g[shape][at].emplace({1.0F, -0.0F, static_cast<float>(i)});
        for (int k = 0; k < i % 11; ++k) g[colours][at].push_back(static_cast<unsigned char>(i + k));
    }
}

/// All that is packed, which is every bit of the particles.
template <class Store>
std::vector<std::uint64_t> bits(const Store& g) {
    std::vector<tsubu::index_t> all(g.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<tsubu::index_t>(i);
    std::vector<std::uint64_t> words(tsubu::packed_words(g, set{}, all));
    tsubu::pack(g, set{}, all, words);
    return words;
}

restart_state some_state() {
    restart_state state;
    state.step = -7;
    state.box = tsubu::restart_box(
        tsubu::triclinic_box<3>({-0.1, 0, 5e-324}, {0.3, 1, 2}, {0.05, -0.1, 0.2}, {true, false, true}));
    state.words = {1, ~std::uint64_t{0}, std::bit_cast<std::uint64_t>(std::nan(""))};
    return state;
}

/// A restart file as bytes: of parts of several ranks, with few particles per block.
template <class Layout = tsubu::soa>
std::string written(const scratch_folder& folder, const std::vector<int>& counts, std::size_t per_block,
                    const std::string& name = "run.restart") {
    std::vector<grains<Layout>> ranks(counts.size());
    std::vector<restart_part> parts;
    int first = 0;
    for (std::size_t r = 0; r < counts.size(); ++r) {
        add_particles(ranks[r], first, counts[r]);
        first += counts[r];
        parts.push_back(tsubu::restart_part_of(ranks[r], set{}, per_block));
    }
    const restart_plan plan(set{}, some_state(), parts, per_block);
    tsubu::atomic_file file(folder / name);
    for (std::size_t r = counts.size(); r-- > 0;) {  // in any order, also before the header
        tsubu::file_writer part(file.temporary_path());
        plan.write_part(part, r, ranks[r], set{});
        part.close();
    }
    plan.write_header(file.writer());
    plan.commit(file);
    CHECK(bytes_of(folder / name).size() == plan.bytes());
    return bytes_of(folder / name);
}

restart_reader<memory_source> reader_of(const std::string& bytes) {
    return restart_reader(memory_source(std::as_bytes(std::span(bytes)), "run.restart"));
}
/// What the reader says of these bytes; the store must stay as it was.
std::string refusal(const std::string& bytes) {
    grains<> g;
    add_particles(g, 1000, 3);
    const auto before = bits(g);
    auto text = thrown<input_error>([&] { reader_of(bytes).read(g, set{}); });
    if (says(text, "nothing was thrown")) return text;
    if (g.owned_count() != 3 || g.size() != 3 || bits(g) != before) text += " AND THE STORE CHANGED";
    return text;
}
std::uint64_t word_at(const std::string& bytes, std::size_t at) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, 8);
    return word;
}
void set_word(std::string& bytes, std::size_t at, std::uint64_t word) { std::memcpy(bytes.data() + at, &word, 8); }
/// Sets word k of the header, and mends its checksum: a file that someone else has made so.
std::string with_header_word(std::string bytes, std::size_t k, std::uint64_t word) {
    set_word(bytes, 8 * k, word);
    const auto end = 8 * (word_at(bytes, 24) - 1);
    set_word(bytes, end, tsubu::crc64_of(std::as_bytes(std::span(bytes)).first(end)));
    return bytes;
}

}  // namespace

TEMPLATE_TEST_CASE("what was written is read, bit for bit", "[io][restart][C4]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<8>) {
    const scratch_folder folder;
    const auto path = folder / "run.restart";
    for (const int count : {0, 1, 2, 1000, 16384, 16385}) {
        grains<TestType> g;
        add_particles(g, 0, count);
        g.push_back_ghost(tsubu::id = 5);  // of another rank
        const auto state = some_state();
        tsubu::write_restart(path, g, set{}, state);
        g.clear_ghosts();
        grains<> h;
        const auto read = tsubu::read_restart(path, h, set{});
        CHECK(h.owned_count() == static_cast<std::size_t>(count));
        CHECK(bits(h) == bits(g));
        CHECK(read == state);
        CHECK(folder.files() == 1);
    }
}

TEST_CASE("the bytes do not depend on the layout", "[io][restart]") {
    const scratch_folder folder;
    const auto soa = written<tsubu::soa>(folder, {10, 0, 33}, 4, "a");
    CHECK(written<tsubu::aos>(folder, {10, 0, 33}, 4, "b") == soa);
    CHECK(written<tsubu::aosoa<16>>(folder, {10, 0, 33}, 4, "c") == soa);
    CHECK(written(folder, {10, 33}, 4, "d") != soa);
}

TEST_CASE("the format is that of its version", "[io][restart]") {
    // Files of version 1 are these bytes. Whoever has reason to change them raises restart_version.
    const scratch_folder folder;
    const auto bytes = written(folder, {5, 0, 4}, 3);
    if constexpr (std::endian::native == std::endian::little) {
        CHECK(bytes.size() == 2056);
        CHECK(tsubu::crc64_of(std::as_bytes(std::span(bytes))) == 0x0A980C7F64ACF41B);
    }
    CHECK(bytes.substr(0, 8) == "\x89tsubu\r\n");
    CHECK(word_at(bytes, 8) == 0x0102030405060708);
    CHECK(word_at(bytes, 16) == 1);
}

TEST_CASE("boxes come back as they were", "[io][restart]") {
    const tsubu::domain<2, float> flat({-0.1F, 0.1F}, {0.3F, 0.7F}, {.periodic = {false, true}});
    const auto again = tsubu::restart_box(flat).as<tsubu::domain<2, float>>();
    for (std::size_t k = 0; k < 2; ++k) {
        CHECK(again.along(k).lo() == flat.along(k).lo());
        CHECK(again.along(k).hi() == flat.along(k).hi());
        CHECK(again.along(k).is_periodic() == flat.along(k).is_periodic());
    }
    // lo + (hi - lo) is not hi here: both faces must be kept.
    const tsubu::domain<1> odd({-3.1794960962080401}, {7.69766158978954}, {});
    CHECK(tsubu::restart_box(odd).as<tsubu::domain<1>>().along(0).hi() == 7.69766158978954);
    const tsubu::triclinic_box<3> tilted({-0.1, 0.1, 1e-3}, {0.3, 0.7, 1.1}, {0.05, -0.2, 0.1}, {true, true, false});
    const auto tilted_again = tsubu::restart_box(tilted).as<tsubu::triclinic_box<3>>();
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(tilted_again.edge(k) == tilted.edge(k));
        CHECK(tilted_again.cell().along(k).is_periodic() == (k != 2));
    }
    CHECK(tilted_again.lo() == tilted.lo());
    CHECK(says(thrown<input_error>([&] { static_cast<void>(tsubu::restart_box(tilted).as<tsubu::domain<3>>()); }),
               "the box is tilted; ask for a triclinic_box"));
    CHECK(says(thrown<input_error>([&] { static_cast<void>(tsubu::restart_box(flat).as<tsubu::domain<3>>()); }),
               "a box of 2 dimensions for one of 3"));
}

TEST_CASE("any number of ranks reads what any number has written", "[io][restart]") {
    const scratch_folder folder;
    grains<> all;
    add_particles(all, 0, 97);
    for (const auto& counts : std::vector<std::vector<int>>{{97}, {50, 47}, {0, 96, 0, 1}, {30, 30, 30, 7}}) {
        const auto bytes = written(folder, counts, 5);
        const auto file = reader_of(bytes);
        CHECK(file.count() == 97);
        CHECK(file.parts().size() == counts.size());
        CHECK(file.fields_in_file()[1].type == "float64[3]");
        CHECK(file.fields_in_file()[4].type == "list of record of 24 bytes");
        grains<> one;
        file.read(one, set{});
        CHECK(bits(one) == bits(all));
        for (const std::uint64_t ranks : {1U, 2U, 3U, 7U, 200U}) {
            CAPTURE(ranks);
            // A share each: together all of them, each once.
            std::vector<std::int64_t> ids;
            for (std::uint64_t r = 0; r < ranks; ++r) {
                grains<> g;
                file.read(g, set{}, tsubu::every_particle{}, {.rank = r, .ranks = ranks});
                for (const auto name : g[tsubu::id]) ids.push_back(name);
            }
            std::sort(ids.begin(), ids.end());
            CHECK(std::equal(ids.begin(), ids.end(), all[tsubu::id].begin(), all[tsubu::id].end()));
            // What a predicate accepts: the same in the order of the file.
            std::size_t kept = 0;
            for (std::uint64_t r = 0; r < ranks; ++r) {
                const auto mine = [&](auto name) { return static_cast<std::uint64_t>(name) / 2 % ranks == r; };
                grains<> g;
                file.read(g, set{}, [&](const auto& particle) { return mine(particle[tsubu::id]); });
                grains<> expected;
                for (int i = 0; i < 97; ++i)
                    if (mine(all[tsubu::id][static_cast<std::size_t>(i)])) add_particles(expected, i, 1);
                CHECK(bits(g) == bits(expected));
                kept += g.size();
            }
            CHECK(kept == 97);
        }
    }
}

TEST_CASE("shares are alike, also when each rank has written one block", "[io][restart]") {
    const scratch_folder folder;
    const auto bytes = written(folder, {1, 1, 0, 1, 1}, 5);
    for (std::uint64_t r = 0; r < 4; ++r) {
        grains<> g;
        reader_of(bytes).read(g, set{}, tsubu::every_particle{}, {.rank = r, .ranks = 4});
        CHECK(g.size() == 1);
    }
}

TEST_CASE("every changed bit is found", "[io][restart][input]") {
    const scratch_folder folder;
    auto bytes = written(folder, {5, 0, 4}, 3);
    grains<> g;
    reader_of(bytes).read(g, set{});
    REQUIRE(g.size() == 9);
    std::size_t found = 0;
    for (auto& byte : bytes)
        for (int bit = 0; bit < 8; ++bit) {
            byte = static_cast<char>(byte ^ (1 << bit));
            const auto text = refusal(bytes);
            byte = static_cast<char>(byte ^ (1 << bit));
            if (says(text, "tsubu::restart_reader: run.restart: byte ") && !says(text, "CHANGED"))
                ++found;
            else
                FAIL_CHECK("bit " << bit << " of byte " << &byte - bytes.data() << ": " << text);
        }
    CHECK(found == 8 * bytes.size());
}

TEST_CASE("files that end too early or go on too long are refused", "[io][restart][input]") {
    const scratch_folder folder;
    const auto bytes = written(folder, {5, 4}, 3);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        const auto text = refusal(bytes.substr(0, length));
        if (!says(text, "run.restart: byte ") || says(text, "CHANGED")) FAIL_CHECK(length << " bytes: " << text);
    }
    CHECK(says(refusal(bytes.substr(0, 20)), "byte 20: the file ends in its header; it is not whole"));
    CHECK(says(refusal(bytes.substr(0, bytes.size() - 1)), "it is not whole; take an older one"));
    CHECK(says(refusal(bytes + '\0'), "the file has " + std::to_string(bytes.size() + 1) + " bytes; its header says " +
                                          std::to_string(bytes.size()) + "; something was appended"));
    CHECK(says(refusal(bytes + bytes), "something was appended"));
}

TEST_CASE("files of others are refused", "[io][restart][input]") {
    const scratch_folder folder;
    const auto bytes = written(folder, {5, 4}, 3);
    CHECK(says(refusal("LAMMPS data file"), "run.restart: byte 0: this is no restart file of tsubu"));
    CHECK(says(refusal(""), "this is no restart file of tsubu"));
    CHECK(says(refusal(std::string(1000, '\0')), "this is no restart file of tsubu"));
    auto text_transfer = bytes;
    text_transfer.erase(6, 1);  // \r\n became \n
    CHECK(says(refusal(text_transfer), "this is no restart file of tsubu"));
    auto other_order = bytes;
    std::reverse(other_order.begin() + 8, other_order.begin() + 16);
    CHECK(says(refusal(other_order), "byte 8: written on a machine of the other byte order"));
    CHECK(says(refusal(with_header_word(bytes, 2, 2)), "byte 16: format version 2; this is a reader of version 1"));

    // A block of another file, or of another place of this one, whose own checksums are right.
    const auto begin = 8 * word_at(bytes, 24);
    const auto block_bytes = 64 + 8 * word_at(bytes, begin + 32);
    auto other = bytes;
    set_word(other, begin + 48, 1);
    set_word(other, begin + 56, tsubu::crc64_of(std::as_bytes(std::span(other)).subspan(begin, 56)));
    CHECK(says(refusal(other),
               "byte " + std::to_string(begin) + ": block 0 of part 0: a block of another place or file"));
    const scratch_folder same_sizes;
    std::vector<grains<>> two(1);
    for (int i = 0; i < 4; ++i) two[0].push_back(tsubu::id = i);
    tsubu::write_restart(same_sizes / "a", two[0], set{});
    auto swapped = bytes_of(same_sizes / "a");
    const restart_plan plan(set{}, {}, {tsubu::restart_part_of(two[0], set{}, 2)}, 2);
    tsubu::atomic_file file(same_sizes / "b");
    plan.write_header(file.writer());
    plan.write_part(file.writer(), 0, two[0], set{});
    plan.commit(file);
    swapped = bytes_of(same_sizes / "b");
    CHECK(says(refusal(swapped), "nothing was thrown"));
    const auto half = (swapped.size() - plan.offset(0)) / 2;
    std::rotate(swapped.end() - static_cast<std::ptrdiff_t>(2 * half),
                swapped.end() - static_cast<std::ptrdiff_t>(half), swapped.end());
    CHECK(says(refusal(swapped), "block 0 of part 0: a block of another place or file lies here"));
    CHECK(block_bytes > 64);
}

TEST_CASE("a file whose fields differ is refused by name", "[io][restart][input]") {
    const scratch_folder folder;
    const auto path = folder / "run.restart";
    tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::position<3>>> g;
    g.push_back(tsubu::id = 3);
    tsubu::write_restart(path, g, tsubu::fields<tsubu::id, tsubu::position<3>>{});
    const auto message = [&]<auto... F>(tsubu::fields<F...> wanted) {
        tsubu::particle_store<tsubu::fields<F...>> h;
        auto text = thrown<input_error>([&] { tsubu::read_restart(path, h, wanted); });
        CHECK(h.empty());
        CHECK(says(text, path));
        return text;
    };
    CHECK(says(message(tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::radius>{}),
               "the file has no field radius; it has id, position; read the fields that were written"));
    CHECK(says(message(tsubu::fields<tsubu::radius, tsubu::id, temperature>{}),
               "the file has no field radius, temperature; it has id, position"));
    CHECK(says(message(tsubu::fields<tsubu::id, tsubu::position<2>>{}),
               "the field position is float64[3] in m; asked for was float64[2] in m"));
    CHECK(says(message(tsubu::fields<tsubu::id, tsubu::position<3, float>>{}), "asked for was float32[3] in m"));
    CHECK(
        says(message(tsubu::fields<tsubu::id, tsubu::field<"position", tsubu::vec<3>, "mm">{}>{}), "float64[3] in mm"));
    CHECK(says(message(tsubu::fields<tsubu::field<"id", std::uint64_t>{}, tsubu::position<3>>{}),
               "the field id is int64 without a unit; asked for was uint64 without a unit"));
    CHECK(says(message(tsubu::fields<tsubu::field<"id", double>{}, tsubu::position<3>>{}), "asked for was float64"));
    CHECK(says(message(tsubu::fields<tsubu::field<"id", tsubu::list_of<std::int64_t>>{}, tsubu::position<3>>{}),
               "asked for was list of int64"));
    // A store may have more: that is zero then.
    tsubu::particle_store<tsubu::fields<temperature, tsubu::position<3>, tsubu::id>> wider;
    tsubu::read_restart(path, wider, tsubu::fields<tsubu::id, tsubu::position<3>>{});
    CHECK(wider[tsubu::id][0] == 3);
    CHECK(wider[temperature][0] == 0);
}

TEST_CASE("some fields of a file are read, in any order", "[io][restart]") {
    const scratch_folder folder;
    const auto bytes = written(folder, {30, 0, 67}, 7);
    const auto file = reader_of(bytes);
    grains<> all;
    add_particles(all, 0, 97);
    const auto check = [&]<auto... F>(tsubu::fields<F...> some) {
        const auto bits_of = [&](const auto& g) {
            std::vector<tsubu::index_t> chosen;
            for (std::size_t i = 0; i < g.size(); ++i) chosen.push_back(static_cast<tsubu::index_t>(i));
            std::vector<std::uint64_t> words(tsubu::packed_words(g, some, chosen));
            tsubu::pack(g, some, chosen, words);
            return words;
        };
        tsubu::particle_store<tsubu::fields<F...>> g;
        file.read(g, some);
        CHECK(g.owned_count() == 97);
        CHECK(bits_of(g) == bits_of(all));
        grains<tsubu::aos> wide;  // the others are zero
        file.read(wide, some);
        CHECK(bits_of(wide) == bits_of(all));
        std::size_t count = 0;
        for (std::uint64_t r = 0; r < 3; ++r) {
            tsubu::particle_store<tsubu::fields<F...>> share;
            file.read(share, some, tsubu::every_particle{}, {.rank = r, .ranks = 3});
            count += share.size();
        }
        CHECK(count == 97);
    };
    using tsubu::fields;
    check(fields<tsubu::id>{});
    check(fields<tsubu::radius, tsubu::id>{});
    check(fields<shape>{});
    check(fields<colours, tsubu::position<3>, contacts>{});
    check(fields<shape, colours, contacts, tsubu::radius, charge, frozen, tsubu::position<3>, tsubu::id>{});
    check(fields<frozen, contacts>{});

    tsubu::particle_store<fields<charge, tsubu::id>> odd;
    file.read(odd, fields<charge, tsubu::id>{},
              [](const auto& particle) { return (particle[tsubu::id] - (std::int64_t{1} << 53)) % 4 == 3; });
    REQUIRE(odd.size() == 48);
    CHECK(odd[tsubu::id][47] == all[tsubu::id][95]);

    grains<> wide;
    file.read(wide, fields<tsubu::radius>{});
    CHECK(wide[tsubu::id][5] == 0);
    CHECK(wide[contacts][7].empty());
}

TEST_CASE("damage is found where fields are passed over, too", "[io][restart][input]") {
    const scratch_folder folder;
    auto bytes = written(folder, {5, 0, 4}, 3);
    const auto refused = [&](const std::string& file) {
        tsubu::particle_store<tsubu::fields<tsubu::radius, tsubu::id>> g;
        g.push_back(tsubu::id = 8);
        auto text = thrown<input_error>([&] { reader_of(file).read(g, tsubu::fields<tsubu::radius, tsubu::id>{}); });
        CHECK((says(text, "nothing was thrown") || (g.size() == 1 && g[tsubu::id][0] == 8)));
        return text;
    };
    CHECK(says(refused(bytes), "nothing was thrown"));
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        bytes[k] = static_cast<char>(bytes[k] ^ 4);
        if (!says(refused(bytes), "run.restart: byte ")) FAIL_CHECK("byte " << k);
        bytes[k] = static_cast<char>(bytes[k] ^ 4);
    }
    // A body that is no particles, though its checksum is right: word 7 says how many contacts, word 8 how many
    // colours.
    const auto begin = 8 * word_at(bytes, 24);
    for (const std::size_t k : {7U, 8U, 9U})
        for (const auto hostile : {~std::uint64_t{0}, ~std::uint64_t{0} / 8, std::uint64_t{9}, std::uint64_t{2}}) {
            auto changed = bytes;
            set_word(changed, begin + 64 + 8 * k, hostile);
            const auto length = 8 * word_at(changed, begin + 32);
            set_word(changed, begin + 40,
                     tsubu::crc64_of(std::as_bytes(std::span(changed)).subspan(begin + 64, length)));
            set_word(changed, begin + 56, tsubu::crc64_of(std::as_bytes(std::span(changed)).subspan(begin, 56)));
            CAPTURE(k, hostile);
            CHECK(says(refused(changed), "block 0 of part 0: "));
        }
    auto foreign = bytes;  // a type that this version does not know
    const auto at = foreign.find("float64[3]");
    REQUIRE(at != std::string::npos);
    foreign.replace(at, 10, "quartz4[3]");
    CHECK(says(refused(with_header_word(foreign, 2, 1)),
               "the field position is quartz4[3], of which the size is not known; read all fields of the file"));
}

TEST_CASE("the texts of types tell their sizes", "[io][restart]") {
    const auto words = [](const std::string& text) { return tsubu::detail::words_of_type(text); };
    const auto text_of = []<class Value>(Value*) { return tsubu::detail::type_text_of<Value>::get(); };
    const auto check = [&]<class Value>(Value* of) {
        CAPTURE(text_of(of));
        const auto found = words(text_of(of));
        REQUIRE(found.has_value());
        CHECK(found->is == tsubu::detail::restart_words_of::kind::fixed);
        CHECK(found->bytes == sizeof(Value));
        const auto list = words(text_of(static_cast<tsubu::list_of<Value>*>(nullptr)));
        CHECK((list && list->is == tsubu::detail::restart_words_of::kind::list && list->bytes == sizeof(Value)));
        const auto bonus = words(text_of(static_cast<tsubu::bonus_of<Value>*>(nullptr)));
        CHECK((bonus && bonus->is == tsubu::detail::restart_words_of::kind::bonus && bonus->bytes == sizeof(Value)));
    };
    enum class colour : unsigned char {};
    check(static_cast<bool*>(nullptr));
    check(static_cast<char*>(nullptr));
    check(static_cast<colour*>(nullptr));
    check(static_cast<std::uint16_t*>(nullptr));
    check(static_cast<std::int64_t*>(nullptr));
    check(static_cast<float*>(nullptr));
    check(static_cast<long double*>(nullptr));
    check(static_cast<contact*>(nullptr));
    check(static_cast<std::array<double, 3>*>(nullptr));
    check(static_cast<std::array<std::array<float, 3>, 2>*>(nullptr));
    for (const std::string text :
         {"", "list of ", "record of bytes", "record of  bytes", "record of 0 bytes", "float", "float64[", "float64[]",
          "float64[0]", "float64[-1]", "float64[99999999999]", "float64[1048576][1048576]", "float64]", "int8 ",
          "real64", "list of list of int8", "record of 99999999999999999999999 bytes", "[3]", "float64[3"})
        if (words(text)) FAIL_CHECK(text);
}

TEST_CASE("counts that cannot be are refused before memory is taken", "[io][restart][input]") {
    const scratch_folder folder;
    const auto bytes = written(folder, {5, 4}, 3);
    const auto most = ~std::uint64_t{0};
    // 3 words of the header, 4 bytes of the file, 7 dimension, 21 how many user words, 25 how many fields.
    for (const std::size_t k : {3U, 4U, 7U, 8U, 21U, 25U})
        for (const auto hostile : {most, most / 2, most / 8, std::uint64_t{1} << 40, std::uint64_t{5000}}) {
            auto changed = bytes;
            set_word(changed, 8 * k, hostile);
            if (k != 3) changed = with_header_word(bytes, k, hostile);
            CAPTURE(k, hostile);
            CHECK(says(refusal(changed), "run.restart: byte "));
        }
    REQUIRE(word_at(bytes, 8 * 21) == 3);  // the words of the user
    REQUIRE(word_at(bytes, 8 * 25) == 8);  // the fields
    const auto header_words = word_at(bytes, 24);
    for (std::size_t k = header_words - 8; k < header_words - 1; ++k)  // how many parts; three numbers of each
        for (const auto hostile :
             {most, most / 8, word_at(bytes, 8 * k) + 1, word_at(bytes, 8 * k) - 1, std::uint64_t{0}}) {
            CAPTURE(k, hostile);
            CHECK(says(refusal(with_header_word(bytes, k, hostile)), "run.restart: byte "));
        }
    auto longer = bytes;  // by a word that nothing tells of
    longer.insert(8 * header_words - 8, 8, '\0');
    set_word(longer, 24, header_words + 1);
    CHECK(says(refusal(with_header_word(longer, 4, longer.size())), "the header goes on after its end"));
    // Of a block: particles and words.
    for (const std::size_t k : {3U, 4U})
        for (const auto hostile : {most, most / 8, std::uint64_t{4}, std::uint64_t{1}, std::uint64_t{0}}) {
            auto changed = bytes;
            const auto begin = 8 * header_words;
            set_word(changed, begin + 8 * k, hostile);
            set_word(changed, begin + 56, tsubu::crc64_of(std::as_bytes(std::span(changed)).subspan(begin, 56)));
            CAPTURE(k, hostile);
            CHECK(says(refusal(changed), "block 0 of part 0: "));
        }
}

TEST_CASE("bodies that fit no particles are refused", "[io][restart][input]") {
    const scratch_folder folder;
    const auto bytes = written(folder, {3}, 3);
    const auto begin = 8 * word_at(bytes, 24);
    const auto body = begin + 64;
    const auto with_body_word = [&](std::size_t k, std::uint64_t word) {
        auto changed = bytes;
        set_word(changed, body + 8 * k, word);
        set_word(changed, begin + 40, tsubu::crc64_of(std::as_bytes(std::span(changed)).subspan(body)));
        set_word(changed, begin + 56, tsubu::crc64_of(std::as_bytes(std::span(changed)).subspan(begin, 56)));
        return changed;
    };
    // id, x, y, z, frozen, charge, radius, how many contacts, how many colours, whether a shape
    REQUIRE(word_at(bytes, body + 32) == 1);
    REQUIRE(word_at(bytes, body + 56) == 0);
    CHECK(says(refusal(with_body_word(0, 77)), "nothing was thrown"));
    CHECK(says(refusal(with_body_word(4, 2)), "a bool that is neither true nor false"));
    CHECK(says(refusal(with_body_word(7, ~std::uint64_t{0})), "its words end too early"));
    CHECK(says(refusal(with_body_word(7, 1)), "block 0 of part 0: "));

    constexpr tsubu::field<"fixed_axes", std::array<bool, 3>> fixed_axes;
    tsubu::particle_store<tsubu::fields<fixed_axes>> g;
    g.push_back(fixed_axes = {true, false, true});
    tsubu::write_restart(folder / "axes.restart", g, tsubu::fields<fixed_axes>{});
    auto axes = bytes_of(folder / "axes.restart");
    const auto block = 8 * word_at(axes, 24);
    REQUIRE(word_at(axes, block + 64) == 0x010001);
    set_word(axes, block + 64, 0x020001);
    set_word(axes, block + 40, tsubu::crc64_of(std::as_bytes(std::span(axes)).subspan(block + 64)));
    set_word(axes, block + 56, tsubu::crc64_of(std::as_bytes(std::span(axes)).subspan(block, 56)));
    CHECK(says(thrown<input_error>([&] { reader_of(axes).read(g, tsubu::fields<fixed_axes>{}); }),
               "a bool that is neither true nor false"));
    CHECK(g.size() == 1);
}

TEST_CASE("a store with ghosts, and a share that is none, are refused", "[io][restart][input]") {
    const scratch_folder folder;
    const auto bytes = written(folder, {5, 4}, 3);
    grains<> g;
    g.push_back_ghost(tsubu::id = 1);
    CHECK(says(thrown<input_error>([&] { reader_of(bytes).read(g, set{}); }), "call clear_ghosts()"));
    g.clear_ghosts();
    const tsubu::restart_share none{.rank = 2, .ranks = 2};
    CHECK(says(thrown<input_error>([&] { reader_of(bytes).read(g, set{}, tsubu::every_particle{}, none); }),
               "share 2 of 2"));
    CHECK(g.empty());
}

TEST_CASE("an exception of the predicate leaves the store as it was", "[io][restart]") {
    const scratch_folder folder;
    const auto bytes = written(folder, {50, 47}, 5);
    grains<> g;
    add_particles(g, 1000, 3);
    const auto before = bits(g);
    int calls = 0;
    CHECK_THROWS_AS(reader_of(bytes).read(g, set{},
                                          [&](const auto&) {
                                              if (++calls == 60) throw 5;
                                              return true;
                                          }),
                    int);
    CHECK(bits(g) == before);
}

TEST_CASE("what was not planned is not written, and half a file not committed", "[io][restart][input]") {
    const scratch_folder folder;
    grains<> g;
    add_particles(g, 0, 20);
    const auto part = tsubu::restart_part_of(g, set{}, 7);
    CHECK(part.blocks == 3);
    const restart_plan plan(set{}, {}, {part, part}, 7);
    {
        tsubu::atomic_file file(folder / "a");
        plan.write_header(file.writer());
        plan.write_part(file.writer(), 0, g, set{});
        CHECK(says(thrown<input_error>([&] { plan.commit(file); }), " of " + std::to_string(plan.bytes())));
        CHECK(says(thrown<input_error>([&] { plan.write_part(file.writer(), 2, g, set{}); }), "of rank 2"));
        g[contacts][0].resize(1000);  // longer than planned: would reach into what comes after
        const auto size = file.writer().size();
        CHECK(says(thrown<input_error>([&] { plan.write_part(file.writer(), 0, g, set{}); }), "not those of the plan"));
        CHECK(file.writer().size() == size);
        g[contacts][0].clear();
        g[contacts][1].clear();
        CHECK(says(thrown<input_error>([&] { plan.write_part(file.writer(), 0, g, set{}); }), "not those of the plan"));
        g.push_back();
        CHECK(says(thrown<input_error>([&] { plan.write_part(file.writer(), 0, g, set{}); }), "not those of the plan"));
    }
    CHECK(folder.files() == 0);
    CHECK(
        says(thrown<input_error>([&] { static_cast<void>(tsubu::restart_part_of(g, set{}, 0)); }), "give at least 1"));
    CHECK(says(thrown<input_error>([&] { static_cast<void>(restart_plan(set{}, {}, {part}, 0)); }), "give at least 1"));
}

TEST_CASE("a part that was never written is found", "[io][restart][input]") {
    const scratch_folder folder;
    grains<> g;
    add_particles(g, 0, 20);
    const auto part = tsubu::restart_part_of(g, set{});
    const restart_plan plan(set{}, {}, {part, part});
    tsubu::atomic_file file(folder / "a");
    plan.write_header(file.writer());
    plan.write_part(file.writer(), 1, g, set{});
    plan.commit(file);  // as long as it must be: a hole of zeros
    CHECK(says(refusal(bytes_of(folder / "a")), "block 0 of part 0: no block begins here"));
}

TEST_CASE("files that cannot be opened or written are told by name", "[io][restart][input]") {
    const scratch_folder folder;
    grains<> g;
    add_particles(g, 0, 2000);
    const auto missing = thrown<file_error>([&] { tsubu::read_restart(folder / "none.restart", g, set{}); });
    INFO(missing);
    CHECK(says(missing, "none.restart: No such file or directory; check the name"));
    CHECK(says(thrown<input_error>([&] { tsubu::read_restart(folder.path(), g, set{}); }), "is not a file"));
    CHECK(
        says(thrown<file_error>([&] { tsubu::write_restart(folder / "none/a", g, set{}); }), "make the folder first"));

    write_bytes(folder / "a", "old");
    const auto old_signal = std::signal(SIGXFSZ, SIG_IGN);
    rlimit old{};
    ::getrlimit(RLIMIT_FSIZE, &old);
    auto limit = old;
    limit.rlim_cur = 10000;
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const auto full = thrown<file_error>([&] { tsubu::write_restart(folder / "a", g, set{}); });
    ::setrlimit(RLIMIT_FSIZE, &old);
    std::signal(SIGXFSZ, old_signal);
    INFO(full);
    CHECK(says(full, "cannot write " + (folder / "a")));
    CHECK(says(full, "File too large"));
    CHECK(bytes_of(folder / "a") == "old");
    CHECK(folder.files() == 1);
}

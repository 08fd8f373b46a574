// SPDX-License-Identifier: MIT
/// @file
/// libFuzzer entry: any text is read or refused; what was read is written, read and written again with the same bytes.
///
///     clang++ -std=c++20 -g -O1 -fsanitize=fuzzer,address,undefined -I include tests/fuzz/lammps_data.cpp
#include <tsubu/io/lammps_data_file.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <type_traits>

namespace {

using everything =
    tsubu::fields<tsubu::id, tsubu::species, tsubu::position<3>, tsubu::velocity<3>, tsubu::image<3>, tsubu::molecule,
                  tsubu::charge, tsubu::bonds, tsubu::angles, tsubu::dihedrals, tsubu::impropers>;
using grains = tsubu::fields<tsubu::id, tsubu::species, tsubu::position<2, float>, tsubu::velocity<2>,
                             tsubu::angular_velocity<2>, tsubu::radius, tsubu::density>;
using atoms = tsubu::fields<tsubu::id, tsubu::species, tsubu::position<3>, tsubu::mass>;

template <class Newton, class Store>
std::string text_of(const Store& store, const tsubu::lammps_header& top) {
    std::string text;
    tsubu::lammps_writer out([&](std::string_view chunk) { text += chunk; }, {.chunk = 64}, Newton{});
    out.write(store, top);
    return text;
}

template <class Fields, class Newton>
void examine(std::string_view input, bool lenient) {
    tsubu::lammps_read_options with{.velocities_may_lack = lenient, .chunk = lenient ? std::size_t{100} : 4096};
    if (lenient) with.unknown = tsubu::unknown_lines::skip;
    tsubu::particle_store<Fields> store;
    tsubu::lammps_header top;
    tsubu::atom_style style{};
    try {
        tsubu::lammps_reader<tsubu::memory_source> file(tsubu::memory_source(input), with);
        file.template read<Newton>(store);
        top = file.header();
        style = file.style();
    } catch (const tsubu::input_error&) {
        if (store.size() != 0) std::abort();  // nothing is stored unless all is
        return;
    }
    // Grains that weigh differently, in a store without radius: there is no style for them.
    if (std::is_same_v<Fields, atoms> && tsubu::is_sphere(style)) return;
    if (top.masses.empty()) top.atoms.types = 0;  // a header may promise types that nothing has
    const auto first = text_of<Newton>(store, top);
    tsubu::particle_store<Fields> again;
    tsubu::lammps_reader<tsubu::memory_source> file(tsubu::memory_source(first), {.velocities_may_lack = true});
    file.template read<Newton>(again);
    if (text_of<Newton>(again, file.header()) != first) {
        std::fputs(first.c_str(), stderr);
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
    const std::string_view text(reinterpret_cast<const char*>(bytes), count);
    examine<everything, tsubu::newton_on>(text, true);
    examine<everything, tsubu::newton_off>(text, false);
    examine<grains, tsubu::newton_on>(text, true);
    examine<atoms, tsubu::newton_on>(text, false);
    return 0;
}

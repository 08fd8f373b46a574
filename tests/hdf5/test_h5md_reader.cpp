// SPDX-License-Identifier: MIT
#include <tsubu/io/h5md_reader.hpp>

#include "hdf5/h5md_examples.hpp"
#include "support/catch.hpp"
#include "unit/io/scratch_folder.hpp"
#include "unit/thrown.hpp"

#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/triclinic_box.hpp>
#include <tsubu/io/h5md_writer.hpp>
#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

using tsubu::file_error;
using tsubu::input_error;

namespace {

using set = tsubu::fields<tsubu::id, tsubu::position<3>>;
using store = tsubu::particle_store<set>;
const tsubu::domain<3> box({0, 0, 0}, {1, 1, 1});

template <std::size_t D>
tsubu::domain<D> box_of(double wider) {
    tsubu::vec<D> lo{};
    tsubu::vec<D> hi{};
    std::array<bool, D> periodic{};
    for (std::size_t k = 0; k < D; ++k) {
        lo[k] = -0.1 / 3 * static_cast<double>(k + 1) - wider;
        hi[k] = 1.0 / 7 + static_cast<double>(k) + wider;
        periodic[k] = k % 2 == 0;
    }
    return {lo, hi, {.periodic = periodic}};
}

template <std::size_t D, class Layout>
void check_round_trip(const std::vector<int>& counts) {
    CAPTURE(D, counts);
    using odd_set = every_type<D>;
    using odd_store = tsubu::particle_store<odd_set, Layout>;
    const scratch_folder folder;
    const auto path = folder / "run.h5";
    {
        tsubu::h5md_writer<odd_set> file(path, box_of<D>(0));
        for (std::size_t k = 0; k < counts.size(); ++k) {
            odd_store g;
            add_odd_particles<D>(g, counts[k], static_cast<int>(k));
            const auto wider = 0.1 * static_cast<double>(k);
            file.append(static_cast<std::int64_t>(1000 * k), 0.1 * static_cast<double>(k), g, box_of<D>(wider));
        }
    }
    const tsubu::h5md_reader file(path);
    REQUIRE(file.frames() == counts.size());
    odd_store all;
    std::size_t total = 0;
    for (std::size_t k = 0; k < counts.size(); ++k) {
        CHECK(file.step(k) == static_cast<std::int64_t>(1000 * k));
        CHECK(file.time(k) == 0.1 * static_cast<double>(k));
        const tsubu::restart_box numbers(box_of<D>(0.1 * static_cast<double>(k)));
        CHECK(file.box(k) == numbers);
        const auto domain = file.box(k).template as<tsubu::domain<D>>();
        CHECK(domain.along(0).hi() == numbers.hi[0]);
        odd_store g;
        add_odd_particles<D>(g, counts[k], static_cast<int>(k));
        odd_store again;
        file.read(k, again, odd_set{});
        CHECK(same_particles(again, g));
        file.read(k, all, odd_set{});
        total += g.size();
    }
    CHECK(all.size() == total);
}

/// A file to break: two frames of 3 and 2 particles.
std::string good_file(const scratch_folder& folder) {
    const auto path = folder / "good.h5";
    tsubu::h5md_writer<set> file(path, box, {.replace = true});
    store g;
    for (int i = 0; i < 3; ++i) g.push_back(tsubu::id = i, tsubu::position<3> = {1.0 * i, 2, 3});
    file.append(10, 0.5, g, box);
    g.swap_remove(2);
    file.append(20, 1.5, g, box);
    return path;
}
/// Opens a file to change it.
struct changed {
    explicit changed(const std::string& path) : file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)) {
        REQUIRE(file.get() >= 0);
    }
    void remove(const char* name) const { REQUIRE(H5Ldelete(file.get(), name, H5P_DEFAULT) >= 0); }
    [[nodiscard]] tsubu::detail::hdf5_object group(const char* name) const {
        tsubu::detail::hdf5_object made(H5Gcreate2(file.get(), name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
        REQUIRE(made.get() >= 0);
        return made;
    }
    template <class Number>
    tsubu::detail::hdf5_object dataset(const char* name, const std::vector<hsize_t>& extents,
                                       const std::vector<Number>& values, const Number* fill = nullptr) const {
        using tsubu::detail::hdf5_object;
        const auto type = tsubu::detail::hdf5_type_of<Number>();
        const hdf5_object space(extents.empty()
                                    ? H5Screate(H5S_SCALAR)
                                    : H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr));
        const hdf5_object properties(H5Pcreate(H5P_DATASET_CREATE));
        if (fill != nullptr) H5Pset_fill_value(properties.get(), type.get(), fill);
        hdf5_object made(
            H5Dcreate2(file.get(), name, type.get(), space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT));
        REQUIRE(made.get() >= 0);
        REQUIRE(H5Dwrite(made.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
        return made;
    }
    template <class Number>
    static void attribute(const tsubu::detail::hdf5_object& of, const char* name, const std::vector<Number>& values,
                          bool is_single = false) {
        using tsubu::detail::hdf5_object;
        const hsize_t count = values.size();
        const auto type = tsubu::detail::hdf5_type_of<Number>();
        const hdf5_object space(is_single ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr));
        const hdf5_object made(H5Acreate2(of.get(), name, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT));
        REQUIRE(H5Awrite(made.get(), type.get(), values.data()) >= 0);
    }

    tsubu::detail::hdf5_object file;
};
std::string refusal(const std::string& path) {
    return thrown<input_error>([&] { static_cast<void>(tsubu::h5md_reader(path)); });
}
template <class Set>
std::string refusal(const std::string& path, Set wanted, std::size_t k = 0) {
    tsubu::particle_store<Set> g;
    g.add_owned(2);
    const auto text = thrown<input_error>([&] { tsubu::h5md_reader(path).read(k, g, wanted); });
    CHECK(g.size() == 2);  // the strong guarantee
    return text;
}

}  // namespace

TEST_CASE("what is read is what was written, bit for bit", "[io][h5md]") {
    const std::vector<int> changing{3, 0, 130, 1, 7, 131, 131};
    check_round_trip<2, tsubu::soa>(changing);
    check_round_trip<3, tsubu::soa>(changing);
    check_round_trip<3, tsubu::aos>({0, 5});
    check_round_trip<2, tsubu::aosoa<8>>({20, 9000, 1});
    check_round_trip<3, tsubu::soa>({17000, 3});
    check_round_trip<2, tsubu::soa>({0});
    check_round_trip<2, tsubu::soa>({});
}
TEST_CASE("a tilted box comes back", "[io][h5md]") {
    const scratch_folder folder;
    const tsubu::triclinic_box<3> tilted({-1, 0.1, 2}, {1.0 / 3, 2, 3}, {0.1, -0.2, 0.7}, {true, false, true});
    const tsubu::triclinic_box<3> later({-1, 0.1, 2}, {1.0 / 3, 2, 4}, {0.2, -0.2, 0.7}, {true, false, true});
    tsubu::h5md_writer<set> file(folder / "run.h5", tilted);
    file.append(1, 0, store{}, tilted);
    file.append(2, 0, store{}, later);
    const tsubu::h5md_reader reader(folder / "run.h5");
    CHECK(reader.box(0) == tsubu::restart_box(tilted));
    CHECK(reader.box(1) == tsubu::restart_box(later));
    CHECK(reader.box(1).as<tsubu::triclinic_box<3>>().edge(2) == later.edge(2));
    const tsubu::triclinic_box<2> flat({0, 0}, {1, 2}, {0.25}, {true, true});
    using flat_set = tsubu::fields<tsubu::position<2>>;
    tsubu::h5md_writer<flat_set>(folder / "flat.h5", flat).append(1, 0, tsubu::particle_store<flat_set>{}, flat);
    CHECK(tsubu::h5md_reader(folder / "flat.h5").box(0) == tsubu::restart_box(flat));
}
TEST_CASE("frames are found by their steps, and some fields can be read alone", "[io][h5md]") {
    const scratch_folder folder;
    const tsubu::h5md_reader file(good_file(folder));
    CHECK(file.elements() == std::vector<std::string>{"id", "position"});
    CHECK(file.find(10) == 0U);
    CHECK(file.find(20) == 1U);
    CHECK(!file.find(15));
    CHECK(!file.find(9));
    CHECK(!file.find(21));
    using ids = tsubu::fields<tsubu::id>;
    tsubu::particle_store<ids> g;
    file.read_step(20, g, ids{});
    CHECK(g.size() == 2);
    // Who asks for the positions alone gets no places without a particle either.
    tsubu::particle_store<tsubu::fields<tsubu::position<3>, tsubu::radius>> places;
    file.read(1, places, tsubu::fields<tsubu::position<3>>{});
    REQUIRE(places.size() == 2);
    CHECK(places[tsubu::position<3>][1] == tsubu::vec<3>{1, 2, 3});
    CHECK(places[tsubu::radius][1] == 0);
    CHECK(says(thrown<input_error>([&] { file.read_step(15, g, ids{}); }),
               "good.h5: /particles/all: there is no frame of step 15; find()"));
    CHECK(says(thrown<input_error>([&] { static_cast<void>(file.step(2)); }), "frame 2 of 2; frames go from 0"));
    CHECK(says(thrown<input_error>([&] { static_cast<void>(file.box(2)); }), "frame 2 of 2"));
    g.push_back_ghost();
    CHECK(says(thrown<input_error>([&] { file.read(0, g, ids{}); }), "ghosts stand after"));
}
TEST_CASE("a field that is not there, or is another, is refused by name", "[io][h5md]") {
    static constexpr tsubu::field<"position", tsubu::vec<3, float>, "m"> narrow;
    static constexpr tsubu::field<"position", tsubu::vec<3>, "km"> far;
    static constexpr tsubu::field<"position", tsubu::vec<2>, "m"> flat;
    static constexpr tsubu::field<"position", double, "m"> single;
    static constexpr tsubu::field<"id", std::int32_t> short_id;
    static constexpr tsubu::field<"id", std::uint64_t> unsigned_id;
    static constexpr tsubu::field<"id", double> real_id;
    static constexpr tsubu::field<"id", bool> is_there;
    const scratch_folder folder;
    const auto path = good_file(folder);
    CHECK(refusal(path, tsubu::fields<tsubu::radius>{}) ==
          "tsubu::h5md_reader: " + path +
              ": /particles/all: there is no radius, but box, id, position; ask for what is there");
    CHECK(refusal(path, tsubu::fields<narrow>{}) ==
          "tsubu::h5md_reader: " + path +
              ": /particles/all/position/value: float64 [2, 3, 3], where float32 per particle " +
              "[3] is wanted; name a field of the type that the file has");
    CHECK(says(refusal(path, tsubu::fields<flat>{}), "where float64 per particle [2] is wanted"));
    CHECK(says(refusal(path, tsubu::fields<single>{}), "where float64 per particle [] is wanted"));
    CHECK(says(refusal(path, tsubu::fields<far>{}), "the unit is m, where 'km' is wanted"));
    CHECK(says(refusal(path, tsubu::fields<short_id>{}), "int64 [2, 3], where int32"));
    CHECK(says(refusal(path, tsubu::fields<unsigned_id>{}), "int64 [2, 3], where uint64"));
    CHECK(says(refusal(path, tsubu::fields<real_id>{}), "int64 [2, 3], where float64"));
    CHECK(says(refusal(path, tsubu::fields<is_there>{}), "int64 [2, 3], where enumeration of int8"));
    CHECK(says(refusal(path, tsubu::fields<tsubu::id>{}, 2), "frame 2 of 2"));
}
TEST_CASE("what is no file, no HDF5 or no H5MD is told apart", "[io][h5md]") {
    const scratch_folder folder;
    CHECK(says(thrown<file_error>([&] { static_cast<void>(tsubu::h5md_reader(folder / "none.h5")); }),
               "cannot open " + folder / "none.h5"));
    CHECK_THROWS_AS(tsubu::h5md_reader(folder.path()), tsubu::error);
    write_bytes(folder / "text", "id x y z\n");
    CHECK(says(refusal(folder / "text"), "text: this is no HDF5 file; check the name"));
    write_bytes(folder / "empty", "");
    CHECK(says(refusal(folder / "empty"), "this is no HDF5 file"));
    {
        const tsubu::detail::hdf5_object file(
            H5Fcreate((folder / "other.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    }
    CHECK(says(refusal(folder / "other.h5"), "there is no group h5md; this is HDF5, but not H5MD"));

    const auto path = good_file(folder);
    changed(path).remove("/particles/all");
    CHECK(says(refusal(path), "it is not told which group is meant: there is nothing"));
    CHECK(says(thrown<input_error>([&] { tsubu::h5md_reader(path, "solid"); }),
               "there is no group solid: there is nothing"));
    changed(path).remove("/particles");
    CHECK(says(refusal(path), "there is no group particles"));
    {
        const changed file(path);
        file.remove("/h5md");
        const auto h5md = file.group("/h5md");
    }
    CHECK(says(refusal(path), "/h5md: there is no attribute version"));
    {
        const changed file(path);
        file.remove("/h5md");
        changed::attribute(file.group("/h5md"), "version", std::vector<int>{2, 0});
    }
    CHECK(says(refusal(path), "version 2.0 of H5MD"));
}
TEST_CASE("a group is chosen by its name if there are several", "[io][h5md]") {
    const scratch_folder folder;
    const auto path = good_file(folder);
    {
        const changed file(path);
        static_cast<void>(file.group("/particles/solid"));
    }
    CHECK(says(refusal(path), "which group is meant: there is all, solid; give the name"));
    CHECK(tsubu::h5md_reader(path, "all").frames() == 2);
    CHECK(tsubu::h5md_reader(path, "solid").frames() == 0);
}
TEST_CASE("a file that was cut anywhere is refused, or reads as before", "[io][h5md]") {
    const scratch_folder folder;
    const auto whole = bytes_of(good_file(folder));
    store expected;
    tsubu::h5md_reader(folder / "good.h5").read(0, expected, set{});
    int refused = 0;
    for (std::size_t size = 0; size < whole.size(); size += 509) {
        write_bytes(folder / "cut.h5", whole.substr(0, size));
        store g;
        try {
            tsubu::h5md_reader(folder / "cut.h5").read(0, g, set{});
            CHECK(same_particles(g, expected));
        } catch (const tsubu::error&) {
            CHECK(g.empty());
            ++refused;
        }
    }
    CHECK(refused == static_cast<int>((whole.size() + 508) / 509));
}
TEST_CASE("a file whose first bytes are damaged is refused", "[io][h5md]") {
    const scratch_folder folder;
    const auto whole = bytes_of(good_file(folder));
    constexpr std::size_t superblock = 48;  // its last four bytes are its checksum
    for (std::size_t at = 0; at < superblock; ++at) {
        CAPTURE(at);
        auto bad = whole;
        bad[at] = static_cast<char>(bad[at] ^ 0x10);
        write_bytes(folder / "bad.h5", bad);
        CHECK_THROWS_AS(tsubu::h5md_reader(folder / "bad.h5"), tsubu::error);
    }
}
TEST_CASE("files of others are read: fixed elements, even steps, no time, no units, fill values", "[io][h5md]") {
    const scratch_folder folder;
    const auto path = good_file(folder);
    {
        const changed file(path);
        file.remove("/particles/all");
        const auto all = file.group("/particles/all");
        static_cast<void>(file.group("/particles/all/position"));
        // Two frames of four places; single precision.
        std::vector<float> x(24);
        for (std::size_t k = 0; k < x.size(); ++k) x[k] = static_cast<float>(k) / 4;
        file.dataset<float>("/particles/all/position/value", {2, 4, 3}, x);
        changed::attribute(file.dataset<int>("/particles/all/position/step", {}, {5}), "offset", std::vector<int>{100},
                           true);
        const int none = 77;
        static_cast<void>(file.group("/particles/all/id"));
        file.dataset<int>("/particles/all/id/value", {2, 4}, {77, 3, 77, 1, 1, 2, 3, 4}, &none);
        file.dataset<int>("/particles/all/id/step", {2}, {100, 105});
        file.dataset<signed char>("/particles/all/species", {4}, {9, 8, 7, -6});
        file.dataset<int>("/particles/all/late", {4}, {1, 2, 3, 4});
        // Sampled at every second frame.
        static_cast<void>(file.group("/particles/all/mass"));
        file.dataset<double>("/particles/all/mass/value", {1, 4}, {1, 2, 3, 4});
        file.dataset<int>("/particles/all/mass/step", {1}, {105});
        file.dataset<double>("/particles/all/radius", {3}, {1, 2, 3});
        const auto walls_of = file.group("/particles/all/box");
        changed::attribute(walls_of, "dimension", std::vector<int>{3}, true);
        const tsubu::detail::hdf5_object text(H5Tcopy(H5T_C_S1));
        H5Tset_size(text.get(), H5T_VARIABLE);
        const hsize_t three = 3;
        const tsubu::detail::hdf5_object space(H5Screate_simple(1, &three, nullptr));
        const tsubu::detail::hdf5_object boundary(
            H5Acreate2(walls_of.get(), "boundary", text.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT));
        const char* words[] = {"periodic", "none", "periodic"};
        REQUIRE(H5Awrite(boundary.get(), text.get(), words) >= 0);
        file.dataset<float>("/particles/all/box/edges", {3}, {2, 3, 4});
    }
    static constexpr tsubu::field<"late", std::int64_t> late;
    using foreign = tsubu::fields<tsubu::position<3>, tsubu::species, tsubu::id, late>;
    const tsubu::h5md_reader file(path);
    REQUIRE(file.frames() == 2);
    CHECK(file.step(1) == 105);
    CHECK(std::isnan(file.time(1)));
    CHECK(file.find(105) == 1U);
    CHECK(!file.find(104));
    tsubu::particle_store<foreign> g;
    file.read(0, g, foreign{});
    REQUIRE(g.size() == 2);
    CHECK(g[tsubu::id][0] == 3);
    CHECK(g[tsubu::id][1] == 1);
    CHECK(g[tsubu::species][1] == -6);
    CHECK(g[late][0] == 2);
    CHECK(g[tsubu::position<3>][1] == tsubu::vec<3>{2.25, 2.5, 2.75});
    file.read(1, g, foreign{});
    CHECK(g.size() == 6);
    tsubu::particle_store<tsubu::fields<tsubu::mass>> heavy;
    file.read(1, heavy, tsubu::fields<tsubu::mass>{});
    CHECK(heavy[tsubu::mass][3] == 4);
    CHECK(says(refusal(path, tsubu::fields<tsubu::mass>{}), "/mass/value: there is nothing of step 100"));
    CHECK(says(refusal(path, tsubu::fields<tsubu::position<3>, tsubu::radius>{}), "3 particles, where others have 4"));
    const auto numbers = file.box(0);
    CHECK(numbers.lengths == tsubu::vec<3>{2, 3, 4});
    CHECK(numbers.hi == tsubu::vec<3>{2, 3, 4});
    CHECK(numbers.periodic == std::array<bool, 3>{true, false, true});
}
TEST_CASE("a bool that is neither FALSE nor TRUE is refused", "[io][h5md]") {
    const scratch_folder folder;
    const auto path = good_file(folder);
    {
        const changed file(path);
        file.dataset<signed char>("/particles/all/frozen", {3}, {0, 1, 2});
    }
    using flags = tsubu::fields<tsubu::id, frozen>;
    CHECK(says(refusal(path, flags{}), "/frozen: a value other than FALSE and TRUE, of particle 2"));
    tsubu::particle_store<flags> g;
    tsubu::h5md_reader(path).read(1, g, flags{});
    REQUIRE(g.size() == 2);
    CHECK(g[frozen][1]);
}
TEST_CASE("a box that is none is refused", "[io][h5md]") {
    const scratch_folder folder;
    const auto path = good_file(folder);
    const auto told = [&](auto&& change) {
        good_file(folder);
        change(changed(path));
        return thrown<input_error>([&] { static_cast<void>(tsubu::h5md_reader(path).box(0)); });
    };
    CHECK(says(told([](const changed& f) { f.remove("/particles/all/box"); }), "there is no box"));
    CHECK(says(told([](const changed& f) {
                   f.remove("/particles/all/box/edges");
                   f.dataset<double>("/particles/all/box/edges", {2}, {1, 2});
               }),
               "[2] in 3 dimensions"));
    CHECK(says(told([](const changed& f) {
                   f.remove("/particles/all/box/edges");
                   f.dataset<double>("/particles/all/box/edges", {3, 3}, {1, 0, 0.5, 0, 1, 0, 0, 0, 1});
               }),
               "edge 0 leaves the axes before it"));
    CHECK(says(told([](const changed& f) {
                   f.remove("/particles/all/box/edges");
                   f.dataset<double>("/particles/all/box/edges", {}, {1});
               }),
               "which is no box"));
    CHECK(says(told([](const changed& f) {
                   f.remove("/particles/all/box");
                   static_cast<void>(f.group("/particles/all/box"));
               }),
               "there is no attribute dimension"));

    using tsubu::detail::hdf5_object;
    const auto with_attribute = [&](const char* name, auto&& put) {
        return told([&](const changed& f) {
            const hdf5_object group(H5Gopen2(f.file.get(), "/particles/all/box", H5P_DEFAULT));
            REQUIRE(H5Adelete(group.get(), name) >= 0);
            put(group);
        });
    };
    CHECK(says(with_attribute("dimension",
                              [](const hdf5_object& of) { changed::attribute<std::int64_t>(of, "dimension", {4}); }),
               "dimension and boundary do not tell of a box of 1, 2 or 3 dimensions"));
    CHECK(says(with_attribute("dimension",
                              [](const hdf5_object& of) { changed::attribute<double>(of, "dimension", {3}); }),
               "the attribute dimension is float64, no whole number"));
    CHECK(says(with_attribute("dimension",
                              [](const hdf5_object& of) {
                                  changed::attribute(of, "dimension", std::vector<std::int64_t>(65, 3));
                              }),
               "the attribute dimension has 65 values"));
    CHECK(says(with_attribute("boundary",
                              [](const hdf5_object& of) {
                                  changed::attribute<std::int64_t>(of, "boundary", {1, 1, 1});
                              }),
               "the attribute boundary is int64, where a text is wanted"));
    CHECK(says(with_attribute("boundary",
                              [](const hdf5_object& of) {
                                  const hdf5_object text(H5Tcopy(H5T_C_S1));
                                  REQUIRE(H5Tset_size(text.get(), 5) >= 0);
                                  const hsize_t count = 3;
                                  const hdf5_object space(H5Screate_simple(1, &count, nullptr));
                                  const hdf5_object made(H5Acreate2(of.get(), "boundary", text.get(), space.get(),
                                                                    H5P_DEFAULT, H5P_DEFAULT));
                                  REQUIRE(H5Awrite(made.get(), text.get(), "none\0open none\0") >= 0);
                              }),
               "the boundary is 'open'; H5MD knows periodic and none"));
    CHECK(says(told([](const changed& f) {
                   f.remove("/particles/all/box/upper");
                   f.dataset<double>("/particles/all/box/upper", {2}, {1, 1});
               }),
               "a corner of 2 numbers in 3 dimensions; leave out lower and upper"));
}
TEST_CASE("a dataset where the particles should be is refused", "[io][h5md]") {
    const scratch_folder folder;
    const auto path = good_file(folder);
    {
        const changed file(path);
        file.remove("/particles/all");
        file.dataset<double>("/particles/all", {2}, {1, 2});
    }
    CHECK(says(refusal(path), "/particles/all: this is no group; check that the file is H5MD"));
}
TEST_CASE("types of HDF5 that no field has are told in words", "[io][h5md]") {
    const auto told = [](hid_t type) { return tsubu::detail::hdf5_kind::of(type).text(); };
    using tsubu::detail::hdf5_object;
    CHECK(told(H5T_C_S1) == "text");
    CHECK(told(H5T_STD_REF_OBJ) == "references");
    CHECK(told(H5T_NATIVE_B8) == "another type");
    const hdf5_object record(H5Tcreate(H5T_COMPOUND, 16));
    CHECK(told(record.get()) == "records");
}
TEST_CASE("a group where a dataset is wanted, and steps that are none, are refused", "[io][h5md]") {
    const scratch_folder folder;
    auto path = good_file(folder);
    {
        const changed file(path);
        static_cast<void>(file.group("/particles/all/radius"));
    }
    CHECK(says(refusal(path, tsubu::fields<tsubu::radius>{}), "/radius: there is no value"));
    {
        const changed file(path);
        static_cast<void>(file.group("/particles/all/radius/value"));
        file.dataset<double>("/particles/all/radius/step", {2}, {10, 20});
    }
    CHECK(says(refusal(path, tsubu::fields<tsubu::radius>{}),
               "/radius/value: there is a group where a dataset is wanted"));
    {
        const changed file(path);
        file.remove("/particles/all/radius/value");
        file.dataset<double>("/particles/all/radius/value", {2, 3}, {1, 2, 3, 4, 5, 6});
    }
    CHECK(says(refusal(path, tsubu::fields<tsubu::radius>{}), "/radius/step: float64, where int64 is wanted"));
}

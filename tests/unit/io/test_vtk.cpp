// SPDX-License-Identifier: MIT
#include <tsubu/io/vtk.hpp>

#include "support/catch.hpp"
#include "unit/io/scratch_folder.hpp"
#include "unit/thrown.hpp"

#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

using tsubu::file_error;
using tsubu::input_error;

namespace {

enum class phase : std::int16_t { solid = -1, liquid = 300 };
struct shape_of {
    float axes[3];
};
inline constexpr tsubu::field<"frozen", bool> frozen{};
inline constexpr tsubu::field<"phase", phase> phase_of{};
inline constexpr tsubu::field<"a<b & \"c\"", float, "<K>"> odd_name{};
inline constexpr tsubu::field<"contacts", tsubu::list_of<int>> contacts{};
inline constexpr tsubu::field<"shape", shape_of> shape{};
inline constexpr tsubu::field<"surface", tsubu::bonus_of<shape_of>> surface{};
inline constexpr tsubu::field<"stress", tsubu::vec<6, float>, "Pa"> stress{};
inline constexpr tsubu::field<"tiny", unsigned char> tiny{};

template <std::size_t D, class Layout>
using grains =
    tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::position<D>, tsubu::velocity<2, float>, frozen, phase_of,
                                        odd_name, contacts, shape, surface, stress, tiny, tsubu::image<1>>,
                          Layout>;

/// What the file has in this attribute of the element that begins with this text.
std::string attribute(const std::string& file, const std::string& element, const std::string& name) {
    const auto begin = file.find(element);
    if (begin == std::string::npos) return "no element " + element;
    const auto end = file.find('>', begin);
    const auto at = file.find(" " + name + "=\"", begin);
    if (at >= end) return "no attribute " + name;
    const auto value = at + name.size() + 3;
    return file.substr(value, file.find('"', value) - value);
}
/// The numbers of an array, after its type and its number of components were compared.
template <class Number>
std::vector<Number> numbers(const std::string& file, const std::string& type, const std::string& name,
                            std::size_t components) {
    const auto element = "<DataArray type=\"" + type + "\" Name=\"" + name + "\"";
    CHECK(attribute(file, element, "NumberOfComponents") == std::to_string(components));
    CHECK(attribute(file, element, "format") == "appended");
    const auto text = attribute(file, element, "offset");
    INFO(element << ": " << text);
    REQUIRE(text.find_first_not_of("0123456789") == std::string::npos);
    const std::string mark = "<AppendedData encoding=\"raw\">\n   _";
    const auto at = file.find(mark) + mark.size() + std::stoul(text);
    std::uint64_t bytes = 0;
    REQUIRE(at + 8 <= file.size());
    std::memcpy(&bytes, file.data() + at, 8);
    REQUIRE(at + 8 + bytes <= file.size());
    REQUIRE(bytes % sizeof(Number) == 0);
    std::vector<Number> values(bytes / sizeof(Number));
    if (!values.empty()) std::memcpy(values.data(), file.data() + at + 8, bytes);
    return values;
}

template <std::size_t D, class Layout>
void check_file(int count) {
    CAPTURE(D, count);
    grains<D, Layout> g;
    const auto n = static_cast<std::size_t>(count);
    for (int i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(
            g.push_back(tsubu::id = (std::int64_t{1} << 53) + i, frozen = i % 2 == 0,
                        phase_of = i % 3 == 0 ? phase::solid : phase::liquid,
                        odd_name = i == 1 ? std::numeric_limits<float>::quiet_NaN() : 0.1F * static_cast<float>(i),
                        tsubu::velocity<2, float> = {static_cast<float>(i), -1}, tiny = static_cast<unsigned char>(i),
                        stress = {1, 2, 3, 4, 5, static_cast<float>(i)}, tsubu::image<1> = {-i}));
        for (std::size_t k = 0; k < D; ++k) g[tsubu::position<D>][at][k] = i + 0.25 * static_cast<double>(k);
        g[contacts][at].resize(static_cast<std::size_t>(i % 5));
        if (i % 4 == 1) g[surface][at].emplace({{1, 2, 3}});
    }
    g.push_back_ghost(tsubu::id = 1);
    const scratch_folder folder;
    tsubu::write_vtp(folder / "a.vtp", g, tsubu::position<D>);
    CHECK(folder.files() == 1);
    const auto file = bytes_of(folder / "a.vtp");

    CHECK(attribute(file, "<VTKFile", "type") == "PolyData");
    CHECK(attribute(file, "<VTKFile", "header_type") == "UInt64");
    CHECK(attribute(file, "<VTKFile", "byte_order") ==
          (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian"));
    CHECK(attribute(file, "<Piece", "NumberOfPoints") == std::to_string(count));
    CHECK(attribute(file, "<Piece", "NumberOfVerts") == std::to_string(count));
    CHECK(says(file, "location=\"vtkDataArray\">m/s</InformationKey></DataArray>"));
    CHECK(says(file, ">&lt;K&gt;</InformationKey>"));
    CHECK_FALSE(says(file, "\"shape\""));

    const auto ids = numbers<std::int64_t>(file, "Int64", "id", 1);
    const auto at = numbers<double>(file, "Float64", "position", 3);
    const auto velocities = numbers<float>(file, "Float32", "velocity", 3);
    const auto flags = numbers<std::uint8_t>(file, "UInt8", "frozen", 1);
    const auto phases = numbers<std::int16_t>(file, "Int16", "phase", 1);
    const auto odd = numbers<float>(file, "Float32", "a&lt;b &amp; &quot;c&quot;", 1);
    const auto lengths = numbers<std::uint32_t>(file, "UInt32", "contacts", 1);
    const auto surfaces = numbers<std::uint8_t>(file, "UInt8", "surface", 1);
    const auto stresses = numbers<float>(file, "Float32", "stress", 6);
    const auto small = numbers<std::uint8_t>(file, "UInt8", "tiny", 1);
    const auto images = numbers<std::int64_t>(file, "Int64", "image", 1);
    const auto points = numbers<std::int32_t>(file, "Int32", "connectivity", 1);
    const auto offsets = numbers<std::int32_t>(file, "Int32", "offsets", 1);
    REQUIRE(ids.size() == n);
    REQUIRE(at.size() == 3 * n);
    REQUIRE(velocities.size() == 3 * n);
    REQUIRE(stresses.size() == 6 * n);
    for (const auto size : {flags.size(), phases.size(), odd.size(), lengths.size(), surfaces.size(), small.size(),
                            images.size(), points.size(), offsets.size()})
        REQUIRE(size == n);
    bool right = true;
    for (std::size_t i = 0; i < n; ++i) {
        const auto row = static_cast<int>(i);
        right = right && ids[i] == (std::int64_t{1} << 53) + row && flags[i] == (i % 2 == 0 ? 1 : 0) &&
                phases[i] == (i % 3 == 0 ? -1 : 300) && lengths[i] == i % 5 && surfaces[i] == (i % 4 == 1 ? 1 : 0) &&
                small[i] == i % 256 && images[i] == -row && points[i] == row && offsets[i] == row + 1;
        right = right && (i == 1 ? std::isnan(odd[i]) : odd[i] == 0.1F * static_cast<float>(row));
        for (std::size_t k = 0; k < 3; ++k)
            right = right && at[3 * i + k] == (k < D ? row + 0.25 * static_cast<double>(k) : 0);
        right = right && velocities[3 * i] == static_cast<float>(row) && velocities[3 * i + 1] == -1 &&
                velocities[3 * i + 2] == 0 && stresses[6 * i] == 1 && stresses[6 * i + 5] == static_cast<float>(row);
    }
    CHECK(right);
    const std::string end = "\n  </AppendedData>\n</VTKFile>\n";
    CHECK(file.substr(file.size() - end.size()) == end);
    // Nothing lies between the arrays and after the last one.
    const auto last = "<DataArray type=\"Int32\" Name=\"offsets\"";
    const std::string mark = "   _";
    CHECK(file.find(mark) + mark.size() + std::stoul(attribute(file, last, "offset")) + 8 + 4 * n + end.size() ==
          file.size());
}

}  // namespace

TEMPLATE_TEST_CASE("every field is in the file, of all layouts and dimensions", "[io][vtk]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<8>) {
    for (const int count : {0, 1, 8191, 8192, 8193}) {
        check_file<1, TestType>(count);
        check_file<2, TestType>(count);
        check_file<3, TestType>(count);
    }
}

TEST_CASE("a .vtp file is this text", "[io][vtk]") {
    const scratch_folder folder;
    tsubu::particle_store<tsubu::fields<tsubu::position<3, float>, tsubu::radius>> g;
    g.push_back();
    tsubu::write_vtp(folder / "a.vtp", g, tsubu::position<3, float>);
    auto file = bytes_of(folder / "a.vtp");
    const std::string begin = R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <PolyData>
    <Piece NumberOfPoints="1" NumberOfVerts="1" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="0">
      <PointData>
        <DataArray type="Float64" Name="radius" NumberOfComponents="1" format="appended" offset="0">)"
                         R"(<InformationKey name="UNITS_LABEL" location="vtkDataArray">m</InformationKey></DataArray>
      </PointData>
      <Points>
        <DataArray type="Float32" Name="position" NumberOfComponents="3" format="appended" offset="16">)"
                         R"(<InformationKey name="UNITS_LABEL" location="vtkDataArray">m</InformationKey></DataArray>
      </Points>
      <Verts>
        <DataArray type="Int32" Name="connectivity" NumberOfComponents="1" format="appended" offset="36"/>
        <DataArray type="Int32" Name="offsets" NumberOfComponents="1" format="appended" offset="48"/>
      </Verts>
    </Piece>
  </PolyData>
  <AppendedData encoding="raw">
   _)";
    if constexpr (std::endian::native == std::endian::little) CHECK(file.substr(0, begin.size()) == begin);
    CHECK(file.size() == begin.size() + 60 + std::string("\n  </AppendedData>\n</VTKFile>\n").size());
}

TEST_CASE("a .pvtp file tells of the same arrays, and names the pieces", "[io][vtk]") {
    const scratch_folder folder;
    const grains<2, tsubu::aos> g;
    const std::vector<std::string> pieces{"run_0.vtp", "a&b/run_1.vtp"};
    tsubu::write_pvtp(folder / "run.pvtp", g, tsubu::position<2>, pieces);
    tsubu::write_vtp(folder / "run_0.vtp", g, tsubu::position<2>);
    CHECK(folder.files() == 2);
    const auto file = bytes_of(folder / "run.pvtp");
    const auto piece = bytes_of(folder / "run_0.vtp");
    CHECK(attribute(file, "<VTKFile", "type") == "PPolyData");
    CHECK(says(file, "    <Piece Source=\"run_0.vtp\"/>\n    <Piece Source=\"a&amp;b/run_1.vtp\"/>\n  </PPolyData>"));
    // <PDataArray type Name NumberOfComponents and the unit: as in the piece, but for where the array lies.
    std::size_t arrays = 0;
    for (auto at = piece.find("<DataArray"); at < piece.find("<Verts>");
         at = piece.find("<DataArray", at + 1), ++arrays) {
        const auto text = piece.substr(at + 1, piece.find(" format", at) - at - 1);
        CAPTURE(text);
        CHECK(says(file, "<P" + text));
    }
    CHECK(arrays == 11);
    CHECK(says(file,
               "<PDataArray type=\"Float64\" Name=\"position\" NumberOfComponents=\"3\"><InformationKey "
               "name=\"UNITS_LABEL\" location=\"vtkDataArray\">m</InformationKey></PDataArray>\n    </PPoints>"));
}

TEST_CASE("a .pvd file names the files of a series by their times", "[io][vtk]") {
    const scratch_folder folder;
    const std::vector<tsubu::vtk_time> series{{0, "a.pvtp"}, {0.1 + 0.2, "b<.pvtp"}};
    tsubu::write_pvd(folder / "run.pvd", series);
    CHECK(says(bytes_of(folder / "run.pvd"),
               "  <Collection>\n    <DataSet timestep=\"0\" part=\"0\" file=\"a.pvtp\"/>\n"
               "    <DataSet timestep=\"0.30000000000000004\" part=\"0\" file=\"b&lt;.pvtp\"/>\n  "
               "</Collection>\n</VTKFile>\n"));
    const std::vector<tsubu::vtk_time> endless{{std::numeric_limits<double>::infinity(), "a.pvtp"}};
    CHECK(says(thrown<input_error>([&] { tsubu::write_pvd(folder / "b.pvd", endless); }),
               "b.pvd: a.pvtp at the time inf; give finite times"));
    CHECK(folder.files() == 1);
}

TEST_CASE("VTK files that cannot be written are told by name", "[io][vtk][input]") {
    const scratch_folder folder;
    const grains<3, tsubu::soa> g;
    CHECK(says(thrown<file_error>([&] { tsubu::write_vtp(folder / "none/a.vtp", g, tsubu::position<3>); }), "a.vtp"));
    CHECK(says(thrown<file_error>([&] { tsubu::write_pvtp(folder / "none/a.pvtp", g, tsubu::position<3>, {}); }),
               "No such file or directory; check the name, and make the folder first"));
    CHECK(folder.files() == 0);
}

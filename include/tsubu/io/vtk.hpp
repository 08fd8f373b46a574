// SPDX-License-Identifier: MIT
/// @file
/// write_vtp, write_pvtp, write_pvd: particles for ParaView and others that read VTK's XML files.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/io/atomic_file.hpp>
#include <tsubu/io/detail/vtk_array.hpp>
#include <tsubu/store/field.hpp>

#include <algorithm>    // std::min
#include <bit>          // std::endian
#include <cmath>        // std::isfinite
#include <cstddef>      // std::byte, std::size_t
#include <cstdint>      // std::int32_t, std::uint64_t
#include <span>         // std::span
#include <string>       // std::string, std::to_string
#include <string_view>  // std::string_view

namespace tsubu {

// A .vtp file is XML that says where in the bytes after it each array lies; the arrays as they are in memory, each
// after its length in bytes:
//
//     <VTKFile ...> ... <DataArray Name="radius" format="appended" offset="16"/> ... _ | length | values | length | ...
//
// All lengths are known before anything is written, so the file is written once from front to end, some particles at a
// time.

namespace detail {

/// The arrays of a .vtp file, in their order: first told of, then written.
class vtk_writer {
public:
    vtk_writer(atomic_file& file, std::size_t count) : file_(file), count_(count) {}

    /// <DataArray .../> for an array of so many components per particle.
    [[nodiscard]] std::string tell(vtk_type type, std::string_view name, std::string_view unit,
                                   std::size_t components) {
        const auto offset = next_;
        next_ += sizeof(std::uint64_t) + std::uint64_t{type.bytes} * components * count_;
        return "        <DataArray type=\"" + name_of(type) + "\" Name=\"" + in_xml(name) +
               "\" NumberOfComponents=\"" + std::to_string(components) + "\" format=\"appended\" offset=\"" +
               std::to_string(offset) + "\"" + unit_of(unit, "DataArray");
    }
    /// Writes the array; put(to, i) writes the numbers of particle i.
    template <class Scalar, class Put>
    void write(std::size_t components, Put&& put) {
        const auto bytes = sizeof(Scalar) * components;  // of a particle
        begin_array(bytes);
        auto* const chunk = reinterpret_cast<Scalar*>(chunk_.data());
        for (std::size_t first = 0; first < count_; first += some) {
            const auto n = (std::min)(some, count_ - first);
            for (std::size_t i = 0; i < n; ++i) put(chunk + i * components, first + i);
            file_.append({chunk_.data(), n * bytes});
        }
    }
    /// The end of an element: /> or the unit, which ParaView shows, and the closing tag.
    [[nodiscard]] static std::string unit_of(std::string_view unit, const std::string& element) {
        if (unit.empty()) return "/>\n";
        return "><InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">" + in_xml(unit) +
               "</InformationKey></" + element + ">\n";
    }
    [[nodiscard]] static std::string begin(const std::string& type) {
        return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" version=\"1.0\" byte_order=\"" +
               (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian") +
               "\" header_type=\"UInt64\">\n";
    }

private:
    static constexpr std::size_t some = 8192;  // particles: a chunk stays in the caches, and is worth a system call

    void begin_array(std::size_t bytes_of_particle) {
        const std::uint64_t length = std::uint64_t{bytes_of_particle} * count_;
        file_.append({reinterpret_cast<const std::byte*>(&length), sizeof(length)});
        const auto needed = (std::min)(some, count_) * bytes_of_particle;
        if (chunk_.size() < needed) chunk_ = buffer<std::byte>(needed, {});
    }

    atomic_file& file_;
    std::size_t count_;
    std::uint64_t next_ = 0;
    buffer<std::byte> chunk_;
};

}  // namespace detail

/// Writes the owned particles of one rank as points, each with a vertex, and their fields as values of the points.
///
///     tsubu::write_vtp("run_0001.vtp", g, tsubu::position<3>);
///
/// Each field has its name, its type and its unit. Two components get a third one, 0; a bool is a UInt8; a list is its
/// length, a bonus whether there is one; records are left out.
///
/// Memory: 8192 particles of a field. Bytes: those of the fields, 24 per position (12 in float), and 8 per vertex.
/// The file is there whole or not at all: see atomic_file.
/// @param position  which field is the points: of 1, 2 or 3 numbers [m]
/// @throws file_error if the folder does not exist, the disk is full, ...; nothing is left then.
template <class Store, particle_field Position>
void write_vtp(const std::string& path, const Store& store, Position position) {
    static_assert(Store::template has<Position>, "the store lacks this position");
    using point = detail::vtk_point<typename Position::value_type>;
    constexpr typename Store::fields_type set{};
    const auto n = store.owned_count();
    atomic_file file(path);
    detail::vtk_writer arrays(file, n);

    auto xml = detail::vtk_writer::begin("PolyData") + "  <PolyData>\n    <Piece NumberOfPoints=\"" +
               std::to_string(n) + "\" NumberOfVerts=\"" + std::to_string(n) +
               "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n      <PointData>\n";
    detail::each_vtk_field<Position>(set, [&]<class Field, class Shown>(Field, Shown) {
        xml += arrays.tell(detail::vtk_type_of<typename Shown::scalar>, Field::name, Field::unit, Shown::components);
    });
    xml += "      </PointData>\n      <Points>\n";  // one statement per array: each tells where the next one lies
    xml += arrays.tell(detail::vtk_type_of<typename point::scalar>, Position::name, Position::unit, 3);
    xml += "      </Points>\n      <Verts>\n";
    xml += arrays.tell(detail::vtk_type_of<std::int32_t>, "connectivity", "", 1);
    xml += arrays.tell(detail::vtk_type_of<std::int32_t>, "offsets", "", 1);
    xml += "      </Verts>\n    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n   _";
    file.append(xml);

    const auto write = [&]<class Field, class Shown>(Field field, Shown) {
        const auto column = store[field];
        arrays.template write<typename Shown::scalar>(Shown::components,
                                                      [&](typename Shown::scalar* to, std::size_t i) {
                                                          Shown::put(to, column[i]);
                                                      });
    };
    detail::each_vtk_field<Position>(set, write);
    write(position, point{});
    arrays.template write<std::int32_t>(1, [](std::int32_t* to, std::size_t i) { *to = static_cast<std::int32_t>(i); });
    arrays.template write<std::int32_t>(1, [](std::int32_t* to, std::size_t i) {
        *to = static_cast<std::int32_t>(i + 1);
    });
    file.append("\n  </AppendedData>\n</VTKFile>\n");
    file.commit();
}

/// Writes the file that joins the .vtp files of all ranks; one rank does it, with a store of the same type.
/// @param pieces  their names, as seen from the folder of this file: {"run_0001_0.vtp", "run_0001_1.vtp"}
/// @throws file_error
template <class Store, particle_field Position>
void write_pvtp(const std::string& path, const Store&, Position, std::span<const std::string> pieces) {
    using point = detail::vtk_point<typename Position::value_type>;
    const auto tell = [](std::string_view name, std::string_view unit, detail::vtk_type type,
                         std::size_t components) {
        return "      <PDataArray type=\"" + name_of(type) + "\" Name=\"" + detail::in_xml(name) + "\" NumberOfComponents=\"" +
               std::to_string(components) + "\"" + detail::vtk_writer::unit_of(unit, "PDataArray");
    };
    auto xml = detail::vtk_writer::begin("PPolyData") + "  <PPolyData GhostLevel=\"0\">\n    <PPointData>\n";
    detail::each_vtk_field<Position>(typename Store::fields_type{}, [&]<class Field, class Shown>(Field, Shown) {
        xml += tell(Field::name, Field::unit, detail::vtk_type_of<typename Shown::scalar>, Shown::components);
    });
    xml += "    </PPointData>\n    <PPoints>\n" +
           tell(Position::name, Position::unit, detail::vtk_type_of<typename point::scalar>, 3) +
           "    </PPoints>\n";
    for (const auto& piece : pieces) xml += "    <Piece Source=\"" + detail::in_xml(piece) + "\"/>\n";
    atomic_file file(path);
    file.append(xml + "  </PPolyData>\n</VTKFile>\n");
    file.commit();
}

/// A file of a series, and the time that it shows.
struct vtk_time {
    double time = 0;   ///< [s]
    std::string file;  ///< .vtp or .pvtp, as seen from the folder of the series
};
/// Writes the .pvd file of a series, for ParaView. @throws file_error; input_error if a time is not finite.
inline void write_pvd(const std::string& path, std::span<const vtk_time> series) {
    auto xml = detail::vtk_writer::begin("Collection") + "  <Collection>\n";
    for (const auto& one : series) {
        if (!std::isfinite(one.time))
            detail::raise<input_error>("write_pvd", path + ": " + one.file + " at the time " + detail::shown(one.time),
                                       "give finite times");
        xml += "    <DataSet timestep=\"" + detail::shown(one.time) + "\" part=\"0\" file=\"" +
               detail::in_xml(one.file) + "\"/>\n";
    }
    atomic_file file(path);
    file.append(xml + "  </Collection>\n</VTKFile>\n");
    file.commit();
}

}  // namespace tsubu

// SPDX-License-Identifier: MIT
/// @file
/// Attributes of HDF5: texts and whole numbers.
#pragma once

#include <tsubu/io/detail/hdf5_library.hpp>
#include <tsubu/io/detail/hdf5_type.hpp>

#include <algorithm>    // std::any_of, std::max, std::min
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int64_t
#include <string>       // std::string, std::to_string
#include <string_view>  // std::string_view
#include <utility>      // std::move
#include <vector>       // std::vector

namespace tsubu::detail {

[[nodiscard]] inline hdf5_object make_hdf5_group(const hdf5_file& file, hid_t parent, const std::string& name,
                                                 const std::string& path) {
    return file.object(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), "make", path);
}

/// @param extents  {} for a single value
inline void write_hdf5_attribute(const hdf5_file& file, hid_t to, const std::string& name, hid_t type,
                                 const std::vector<hsize_t>& extents, const void* values) {
    const auto space =
        file.object(extents.empty() ? H5Screate(H5S_SCALAR)
                                    : H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr),
                    "write the attribute", name);
    const auto attribute = file.object(H5Acreate2(to, name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT),
                                       "write the attribute", name);
    file.checked(H5Awrite(attribute.get(), type, values), "write the attribute", name);
}
[[nodiscard]] inline hdf5_object hdf5_text_type(const hdf5_file& file, std::size_t length, bool is_ascii) {
    auto type = file.object(H5Tcopy(H5T_C_S1), "make", "a type");
    file.checked(H5Tset_size(type.get(), length), "make", "a type");
    file.checked(H5Tset_cset(type.get(), is_ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8), "make", "a type");
    return type;
}
[[nodiscard]] inline bool is_ascii(std::string_view text) noexcept {
    return !std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) > 127; });
}
/// Of fixed length, as H5MD wants it.
inline void write_hdf5_text(const hdf5_file& file, hid_t to, const std::string& name, const std::string& text) {
    const auto type = hdf5_text_type(file, (std::max)(text.size(), std::size_t{1}), is_ascii(text));  // HDF5: not 0
    write_hdf5_attribute(file, to, name, type.get(), {}, text.c_str());
}
/// Of variable length, as the module units wants it.
inline void write_hdf5_long_text(const hdf5_file& file, hid_t to, const std::string& name, const std::string& text) {
    const auto type = hdf5_text_type(file, H5T_VARIABLE, is_ascii(text));
    const char* const start = text.c_str();
    write_hdf5_attribute(file, to, name, type.get(), {}, &start);
}

/// An attribute, its kind, and how many values it has.
struct hdf5_attribute {
    hdf5_object object;
    hdf5_object type;
    hdf5_kind kind;
    std::size_t count = 0;
};
/// @param path  of the object that it belongs to, for errors
[[nodiscard]] inline hdf5_attribute open_hdf5_attribute(const hdf5_file& file, hid_t of, const std::string& name,
                                                        const std::string& path) {
    if (file.checked(H5Aexists(of, name.c_str()), "read", path) == 0)
        file.refuse(path, "there is no attribute " + name, "H5MD asks for it: write the file again, with it");
    hdf5_attribute attribute;
    attribute.object = file.object(H5Aopen(of, name.c_str(), H5P_DEFAULT), "read the attribute", path + "/" + name);
    attribute.type = file.object(H5Aget_type(attribute.object.get()), "read", path + "/" + name);
    attribute.kind = hdf5_kind::of(attribute.type.get());
    const auto space = file.object(H5Aget_space(attribute.object.get()), "read", path + "/" + name);
    attribute.count =
        static_cast<std::size_t>(file.checked(H5Sget_simple_extent_npoints(space.get()), "read", path + "/" + name));
    constexpr std::size_t most = 64;  // no attribute of H5MD has as many
    if (attribute.count > most)
        file.refuse(path, "the attribute " + name + " has " + std::to_string(attribute.count) + " values",
                    "check that the file is whole");
    return attribute;
}
[[nodiscard]] inline std::vector<std::int64_t> read_hdf5_integers(const hdf5_file& file, hid_t of,
                                                                  const std::string& name, const std::string& path) {
    const auto attribute = open_hdf5_attribute(file, of, name, path);
    if (!attribute.kind.is_integer())
        file.refuse(path, "the attribute " + name + " is " + attribute.kind.text() + ", no whole number",
                    "H5MD asks for whole numbers");
    std::vector<std::int64_t> values(attribute.count);
    if (!values.empty())
        file.checked(H5Aread(attribute.object.get(), H5T_NATIVE_INT64, values.data()), "read", path + "/" + name);
    return values;
}
[[nodiscard]] inline std::vector<std::string> read_hdf5_texts(const hdf5_file& file, hid_t of, const std::string& name,
                                                              const std::string& path) {
    const auto attribute = open_hdf5_attribute(file, of, name, path);
    const auto refuse = [&] {
        file.refuse(path, "the attribute " + name + " is " + attribute.kind.text() + ", where a text is wanted",
                    "H5MD asks for a text");
    };
    if (attribute.kind.type_class != H5T_STRING) refuse();
    std::vector<std::string> texts;
    if (attribute.count == 0) return texts;
    if (H5Tis_variable_str(attribute.type.get()) > 0) {
        std::vector<char*> starts(attribute.count, nullptr);
        file.checked(H5Aread(attribute.object.get(), attribute.type.get(), starts.data()), "read", path + "/" + name);
        try {
            for (const char* start : starts) texts.emplace_back(start == nullptr ? "" : start);
        } catch (...) {
            for (char* start : starts) H5free_memory(start);
            throw;
        }
        for (char* start : starts) H5free_memory(start);
        return texts;
    }
    constexpr std::size_t longest = 65536;  // bytes: no attribute in the header of an object is longer
    if (attribute.kind.bytes == 0 || attribute.kind.bytes > longest) refuse();
    std::vector<char> characters(attribute.count * attribute.kind.bytes);
    file.checked(H5Aread(attribute.object.get(), attribute.type.get(), characters.data()), "read", path + "/" + name);
    for (std::size_t k = 0; k < attribute.count; ++k) {
        std::string text(characters.data() + k * attribute.kind.bytes, attribute.kind.bytes);
        text.resize((std::min)(text.size(), text.find('\0')));
        while (!text.empty() && text.back() == ' ') text.pop_back();  // as Fortran pads
        texts.push_back(std::move(text));
    }
    return texts;
}

}  // namespace tsubu::detail

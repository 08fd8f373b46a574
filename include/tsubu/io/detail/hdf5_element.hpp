// SPDX-License-Identifier: MIT
/// @file
/// An element of an H5MD file that is being read: fixed, or a value per frame.
#pragma once

#include <tsubu/io/detail/hdf5_attribute.hpp>
#include <tsubu/io/detail/hdf5_library.hpp>
#include <tsubu/io/detail/hdf5_type.hpp>
#include <tsubu/io/detail/hdf5_unit.hpp>

#include <algorithm>    // std::equal, std::min
#include <cstddef>      // std::ptrdiff_t, std::size_t
#include <cstdint>      // std::int64_t, std::uint64_t
#include <optional>     // std::optional
#include <string>       // std::string, std::to_string
#include <string_view>  // std::string_view
#include <type_traits>  // std::is_integral_v, std::is_same_v
#include <utility>      // std::move
#include <vector>       // std::vector

namespace tsubu::detail {

/// A dataset, its kind and its extents.
struct hdf5_dataset {
    hdf5_object object;
    hdf5_kind kind;
    std::vector<hsize_t> extents;
    std::string path;
};

[[nodiscard]] inline bool has_hdf5_link(const hdf5_file& file, hid_t group, const std::string& name,
                                        const std::string& path) {
    return file.checked(H5Lexists(group, name.c_str(), H5P_DEFAULT), "read", path) > 0;
}
[[nodiscard]] inline hdf5_dataset as_hdf5_dataset(const hdf5_file& file, hdf5_object object, std::string path) {
    hdf5_dataset dataset;
    dataset.path = std::move(path);
    dataset.object = std::move(object);
    if (H5Iget_type(dataset.object.get()) != H5I_DATASET)
        file.refuse(dataset.path, "there is a group where a dataset is wanted", "check that the file is H5MD");
    const auto type = file.object(H5Dget_type(dataset.object.get()), "read", dataset.path);
    dataset.kind = hdf5_kind::of(type.get());
    const auto space = file.object(H5Dget_space(dataset.object.get()), "read", dataset.path);
    const auto rank = file.checked(H5Sget_simple_extent_ndims(space.get()), "read", dataset.path);
    dataset.extents.resize(static_cast<std::size_t>(rank));
    file.checked(H5Sget_simple_extent_dims(space.get(), dataset.extents.data(), nullptr), "read", dataset.path);
    return dataset;
}
[[nodiscard]] inline hdf5_object open_hdf5(const hdf5_file& file, hid_t group, const std::string& name,
                                           const std::string& path) {
    return file.object(H5Oopen(group, name.c_str(), H5P_DEFAULT), "read", path);
}
/// What there is of names in a group.
[[nodiscard]] inline std::vector<std::string> names_in(const hdf5_file& file, hid_t group, const std::string& path) {
    H5G_info_t about{};
    file.checked(H5Gget_info(group, &about), "read", path);
    std::vector<std::string> names;
    for (hsize_t k = 0; k < about.nlinks; ++k) {
        const auto name = [&](char* to, std::size_t size) {
            return file.checked(H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, to, size, H5P_DEFAULT),
                                "read", path);
        };
        std::string text(static_cast<std::size_t>(name(nullptr, 0)), '\0');
        name(text.data(), text.size() + 1);
        names.push_back(std::move(text));
    }
    return names;
}
/// "id, position, velocity", or "nothing"
[[nodiscard]] inline std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const auto& name : names) {
        if (!text.empty()) text += ", ";
        text += name;
    }
    return text.empty() ? "nothing" : text;
}

/// Reads a part of a dataset. @param start, shape  of as many extents as it has; none for a single value
inline void read_hdf5(const hdf5_file& file, const hdf5_dataset& dataset, const std::vector<hsize_t>& start,
                      const std::vector<hsize_t>& shape, hid_t type, void* to) {
    const auto file_space = file.object(H5Dget_space(dataset.object.get()), "read", dataset.path);
    if (shape.empty()) {
        file.checked(H5Dread(dataset.object.get(), type, H5S_ALL, file_space.get(), H5P_DEFAULT, to), "read",
                     dataset.path);
        return;
    }
    const auto memory_space =
        file.object(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), "read", dataset.path);
    file.checked(H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr, shape.data(), nullptr),
                 "read", dataset.path);
    file.checked(H5Dread(dataset.object.get(), type, memory_space.get(), file_space.get(), H5P_DEFAULT, to), "read",
                 dataset.path);
}

/// The steps, or the times, of an element: one by one, or at equal distances.
template <class Number>
class hdf5_series_of {
public:
    hdf5_series_of() = default;
    /// @param frames  how many values the element has
    hdf5_series_of(const hdf5_file& file, hdf5_dataset dataset, hsize_t frames) : dataset_(std::move(dataset)) {
        constexpr bool is_step = std::is_same_v<Number, std::int64_t>;
        const bool good = is_step ? dataset_.kind.template fits<Number>()
                                  : dataset_.kind.is_integer() || dataset_.kind.type_class == H5T_FLOAT;
        if (!good)
            file.refuse(dataset_.path,
                        dataset_.kind.text() + (is_step ? ", where int64 is wanted" : ", which is no time"),
                        "check that the file is H5MD");
        if (dataset_.extents.empty()) {
            read_hdf5(file, dataset_, {}, {}, memory_type().get(), &distance_);
            if (file.checked(H5Aexists(dataset_.object.get(), "offset"), "read", dataset_.path) > 0) {
                const auto offset = open_hdf5_attribute(file, dataset_.object.get(), "offset", dataset_.path);
                if (offset.count == 1)
                    file.checked(H5Aread(offset.object.get(), memory_type().get(), &offset_), "read", dataset_.path);
            }
            count_ = frames;
        } else if (dataset_.extents.size() == 1) {
            count_ = dataset_.extents[0];
        } else {
            file.refuse(dataset_.path, shown_extents(dataset_.extents) + " numbers, where one per frame is wanted",
                        "check that the file is H5MD");
        }
    }
    [[nodiscard]] hsize_t count() const noexcept { return count_; }
    [[nodiscard]] Number at(const hdf5_file& file, hsize_t k) const {
        if (dataset_.extents.empty()) {
            if constexpr (std::is_integral_v<Number>)  // a damaged file may have any distance
                return static_cast<Number>(static_cast<std::uint64_t>(offset_) +
                                           k * static_cast<std::uint64_t>(distance_));
            else
                return offset_ + static_cast<Number>(k) * distance_;
        }
        Number value{};
        read_hdf5(file, dataset_, {k}, {1}, memory_type().get(), &value);
        return value;
    }
    /// Where a step is. Steps grow.
    [[nodiscard]] std::optional<hsize_t> find(const hdf5_file& file, Number value) const {
        hsize_t low = 0;
        for (hsize_t high = count_; low < high;) {
            const auto middle = low + (high - low) / 2;
            const auto met = at(file, middle);
            if (met == value) return middle;
            if (met < value)
                low = middle + 1;
            else
                high = middle;
        }
        return std::nullopt;
    }

private:
    [[nodiscard]] static hdf5_object memory_type() { return hdf5_type_of<Number>(); }

    hdf5_dataset dataset_;
    Number distance_ = 0;
    Number offset_ = 0;
    hsize_t count_ = 0;
};

/// An element of a group.
struct hdf5_element {
    hdf5_dataset value;
    bool is_fixed = false;               ///< one value for all frames
    hdf5_object group;                   ///< if it is not fixed
    hdf5_series_of<std::int64_t> steps;  ///< if it is not fixed
    hsize_t frames = 0;                  ///< that are whole: of which there is a step, too
};
[[nodiscard]] inline hdf5_element open_hdf5_element(const hdf5_file& file, hid_t parent, const std::string& parent_path,
                                                    const std::string& name) {
    const auto path = parent_path + "/" + name;
    if (!has_hdf5_link(file, parent, name, path))
        file.refuse(parent_path, "there is no " + name + ", but " + joined(names_in(file, parent, parent_path)),
                    "ask for what is there");
    hdf5_element element;
    auto object = open_hdf5(file, parent, name, path);
    element.is_fixed = H5Iget_type(object.get()) == H5I_DATASET;
    if (element.is_fixed) {
        element.value = as_hdf5_dataset(file, std::move(object), path);
        return element;
    }
    for (const char* part : {"value", "step"})
        if (!has_hdf5_link(file, object.get(), part, path + "/" + part))
            file.refuse(path, "there is no " + std::string(part), "check that the file is H5MD");
    element.value = as_hdf5_dataset(file, open_hdf5(file, object.get(), "value", path + "/value"), path + "/value");
    if (element.value.extents.empty())
        file.refuse(element.value.path, "a single value, where one per frame is wanted", "check that the file is H5MD");
    element.steps = {file, as_hdf5_dataset(file, open_hdf5(file, object.get(), "step", path + "/step"), path + "/step"),
                     element.value.extents[0]};
    element.frames = (std::min)(element.value.extents[0], element.steps.count());
    element.group = std::move(object);
    return element;
}
/// Where in an element the frame k of this step is. @throws input_error if it has none.
[[nodiscard]] inline hsize_t row_of(const hdf5_file& file, const hdf5_element& element, hsize_t k, std::int64_t step) {
    if (element.is_fixed) return 0;
    if (k < element.frames && element.steps.at(file, k) == step) return k;
    const auto row = element.steps.find(file, step);
    if (!row || *row >= element.frames)
        file.refuse(element.value.path, "there is nothing of step " + std::to_string(step),
                    "ask for a step at which it was written");
    return *row;
}
/// Refuses a dataset of another unit, type or shape than wanted. A unit that is not told is taken for the right one.
template <hdf5_number Scalar>
void check_hdf5_value(const hdf5_file& file, const hdf5_element& element, const std::vector<hsize_t>& extents,
                      std::string_view field_unit) {
    const auto& value = element.value;
    const auto& own = value.extents;
    const std::size_t before = element.is_fixed ? 1 : 2;  // frame, particle
    if (!value.kind.fits<Scalar>() || own.size() != before + extents.size() ||
        !std::equal(extents.begin(), extents.end(), own.end() - static_cast<std::ptrdiff_t>(extents.size()))) {
        const auto type = hdf5_type_of<Scalar>();
        file.refuse(value.path,
                    value.kind.text() + " " + shown_extents(own) + ", where " + hdf5_kind::of(type.get()).text() +
                        " per particle " + shown_extents(extents) + " is wanted",
                    "name a field of the type that the file has");
    }
    if (file.checked(H5Aexists(value.object.get(), "unit"), "read", value.path) > 0) {
        const auto units = read_hdf5_texts(file, value.object.get(), "unit", value.path);
        const auto wanted = h5md_unit(field_unit);
        if (units.size() != 1 || units[0] != wanted)
            file.refuse(value.path, "the unit is " + joined(units) + ", where '" + wanted + "' is wanted",
                        "name a field of the unit that the file has");
    }
}

}  // namespace tsubu::detail

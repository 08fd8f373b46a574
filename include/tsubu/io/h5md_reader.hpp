// SPDX-License-Identifier: MIT
/// @file
/// h5md_reader: frames of an H5MD file, whoever has written it.
#pragma once

#include <tsubu/core/vec.hpp>
#include <tsubu/io/byte_source.hpp>
#include <tsubu/io/detail/hdf5_attribute.hpp>
#include <tsubu/io/detail/hdf5_element.hpp>
#include <tsubu/io/detail/hdf5_library.hpp>
#include <tsubu/io/detail/hdf5_type.hpp>
#include <tsubu/io/file_error.hpp>
#include <tsubu/io/restart_state.hpp>
#include <tsubu/store/field.hpp>

#include <algorithm>    // std::find, std::min
#include <array>        // std::array
#include <cstddef>      // std::byte, std::size_t
#include <cstdint>      // std::int64_t, std::uint64_t
#include <cstdio>       // std::fclose, std::fopen
#include <cstring>      // std::memcpy
#include <limits>       // std::numeric_limits
#include <new>          // std::bad_alloc
#include <optional>     // std::optional
#include <string>       // std::string, std::to_string
#include <type_traits>  // std::conditional_t, std::is_same_v, std::remove_cv_t
#include <utility>      // std::move, std::swap
#include <vector>       // std::erase, std::vector

namespace tsubu {

/// What is in this H5MD file, and in frame k of it?
///
///     tsubu::h5md_reader file("run.h5");
///     for (std::size_t k = 0; k < file.frames(); ++k) {
///         g.clear();
///         file.read(k, g, tsubu::fields<tsubu::id, tsubu::position<3>>{});
///     }
///
/// Files of others are read as well: elements that do not change, equally spaced steps, particles whose id is the fill
/// value, 32-bit numbers into 64-bit fields. What would lose something is refused: a wider type, another unit, another
/// shape, a field of which there is nothing at this step. So is a file that is not whole, as far as HDF5 notices.
///
/// Frames are those of `position`, or else of the first element that has any.
///
/// Threads: one at a time, of all that use HDF5 in this program.
/// Source:  H5MD 1.1.
class h5md_reader {
public:
    /// @param group  /particles/<group>; may be empty if there is one only
    /// @throws file_error if there is no file, ...; input_error if it is no H5MD 1 file, or has no such group.
    explicit h5md_reader(std::string path, const std::string& group = {}) : file_("h5md_reader", std::move(path)) {
        const detail::quiet_hdf5 quiet;
        open();
        check_version();
        open_group(group);
        find_frames();
    }

    [[nodiscard]] const std::string& path() const noexcept { return file_.path(); }
    [[nodiscard]] std::size_t frames() const noexcept { return static_cast<std::size_t>(main_.frames); }
    /// The names of the fields, and whatever else lies in the group, but the box.
    [[nodiscard]] std::vector<std::string> elements() const {
        const detail::quiet_hdf5 quiet;
        auto names = detail::names_in(file_, group_.get(), group_path_);
        std::erase(names, "box");
        return names;
    }
    /// @throws input_error if there is no such frame; so do all that take one.
    [[nodiscard]] std::int64_t step(std::size_t k) const {
        const detail::quiet_hdf5 quiet;
        check_frame(k);
        return main_.steps.at(file_, k);
    }
    /// [s]; NaN if the file does not tell.
    [[nodiscard]] double time(std::size_t k) const {
        const detail::quiet_hdf5 quiet;
        check_frame(k);
        if (k >= times_.count()) return std::numeric_limits<double>::quiet_NaN();
        return times_.at(file_, k);
    }
    /// The frame of this step, if there is one. O(log frames).
    [[nodiscard]] std::optional<std::size_t> find(std::int64_t step) const {
        const detail::quiet_hdf5 quiet;
        const auto row = main_.steps.find(file_, step);
        if (!row || *row >= main_.frames) return std::nullopt;
        return static_cast<std::size_t>(*row);
    }
    /// `file.box(k).as<tsubu::domain<3>>()`. The corner is 0 in files of others: H5MD does not tell it. Lengths are 0
    /// if there are none. @throws input_error if the edges are neither straight nor those of a triclinic_box.
    [[nodiscard]] restart_box box(std::size_t k) const {
        const detail::quiet_hdf5 quiet;
        check_frame(k);
        return read_box(k);
    }

    /// Adds the particles of a frame as owned ones; fields that are not in the set are zero.
    /// Memory: 8192 particles of a field. Strong guarantee; views end in any case.
    /// @throws input_error if a field is not there, or of another type, unit or shape, or the store has ghosts;
    ///         limit_error from 2^31 particles on; file_error if the disk fails.
    template <auto... F, class Store>
    void read(std::size_t k, Store& store, fields<F...> set) const {
        static_assert(sizeof...(F) > 0, "name the fields that are to be read");
        static_assert(
            (detail::hdf5_value<typename std::remove_cv_t<decltype(F)>::value_type>::exists && ...),
            "an H5MD file has numbers of up to 64 bits and std::arrays of them: no list_of, bonus_of or records");
        static_assert((Store::template has<std::remove_cv_t<decltype(F)>> && ...),
                      "the store lacks a field that is to be read");
        const detail::quiet_hdf5 quiet;
        check_frame(k);
        const auto before = store.size();
        store.add_owned(0);  // refuses ghosts, before any work
        try {
            read_frame(k, store, set);
        } catch (...) {
            drop(store, before);
            throw;
        }
    }
    /// The frame of this step. @throws as above; input_error if there is none.
    template <auto... F, class Store>
    void read_step(std::int64_t step, Store& store, fields<F...> set) const {
        const auto k = find(step);
        if (!k)
            file_.refuse(group_path_, "there is no frame of step " + std::to_string(step),
                         "find() tells which there are");
        read(*k, store, set);
    }

private:
    static constexpr std::size_t block = 8192;  // particles

    /// An element that is read, and its row.
    struct source {
        detail::hdf5_element element;
        hsize_t row = 0;

        [[nodiscard]] hsize_t particles() const noexcept { return element.value.extents[element.is_fixed ? 0 : 1]; }
        /// The part of the file that these particles are.
        void read(const detail::hdf5_file& file, hsize_t first, hsize_t count, hid_t type, void* to) const {
            auto shape = element.value.extents;
            std::vector<hsize_t> start(shape.size(), 0);
            std::size_t k = 0;
            if (!element.is_fixed) {
                start[k] = row;
                shape[k++] = 1;
            }
            start[k] = first;
            shape[k] = count;
            detail::read_hdf5(file, element.value, start, shape, type, to);
        }
    };

    void open() {
        static_cast<void>(file_source(file_.path()));  // HDF5 tells of what is no file in too many words, or waits
        if (H5Fis_hdf5(file_.path().c_str()) == 0) file_.refuse("", "this is no HDF5 file", "check the name");
        file_.take(H5Fopen(file_.path().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open");
    }
    void check_version() {
        if (!detail::has_hdf5_link(file_, file_.get(), "h5md", "/h5md"))
            file_.refuse("", "there is no group h5md", "this is HDF5, but not H5MD; check the name");
        const auto h5md = detail::open_hdf5(file_, file_.get(), "h5md", "/h5md");
        const auto version = detail::read_hdf5_integers(file_, h5md.get(), "version", "/h5md");
        if (version.size() != 2 || version[0] != 1) {
            std::string told;
            for (const auto part : version) {
                if (!told.empty()) told += '.';
                told += std::to_string(part);
            }
            file_.refuse("/h5md", "version " + told + " of H5MD", "write the file as H5MD 1.0 or 1.1");
        }
    }
    void open_group(const std::string& group) {
        if (!detail::has_hdf5_link(file_, file_.get(), "particles", "/particles"))
            file_.refuse("", "there is no group particles", "this file has no particles; check the name");
        const auto particles = detail::open_hdf5(file_, file_.get(), "particles", "/particles");
        auto name = group;
        const auto names = detail::names_in(file_, particles.get(), "/particles");
        if (name.empty() && names.size() == 1) name = names[0];
        if (std::find(names.begin(), names.end(), name) == names.end())
            file_.refuse("/particles",
                         (name.empty() ? std::string("it is not told which group is meant")
                                       : "there is no group " + name) +
                             ": there is " + detail::joined(names),
                         "give the name of a group");
        group_path_ = "/particles/" + name;
        group_ = detail::open_hdf5(file_, particles.get(), name, group_path_);
        if (H5Iget_type(group_.get()) != H5I_GROUP)
            file_.refuse(group_path_, "this is no group", "check that the file is H5MD");
    }
    void find_frames() {
        auto names = elements();
        for (auto& name : names)
            if (name == "position") std::swap(name, names.front());
        for (const auto& name : names) {
            auto element = detail::open_hdf5_element(file_, group_.get(), group_path_, name);
            if (element.is_fixed) continue;
            main_ = std::move(element);
            break;
        }
        if (!main_.group) return;
        const auto path = main_.value.path.substr(0, main_.value.path.rfind('/')) + "/time";
        if (detail::has_hdf5_link(file_, main_.group.get(), "time", path))
            times_ = {file_,
                      detail::as_hdf5_dataset(file_, detail::open_hdf5(file_, main_.group.get(), "time", path), path),
                      main_.frames};
    }
    void check_frame(std::size_t k) const {
        if (k >= main_.frames)
            file_.refuse(group_path_, "frame " + std::to_string(k) + " of " + std::to_string(main_.frames),
                         "frames go from 0 to frames() - 1");
    }

    /// One row of an element of the box: 1 to 9 numbers; none if it is not there.
    [[nodiscard]] std::vector<double> row_of_box(hid_t box, const std::string& path, const char* name, std::size_t k,
                                                 std::vector<hsize_t>& extents) const {
        std::vector<double> numbers;
        if (!detail::has_hdf5_link(file_, box, name, path)) return numbers;
        const auto element = detail::open_hdf5_element(file_, box, path, name);
        const auto& value = element.value;
        extents = value.extents;
        std::vector<hsize_t> start(extents.size(), 0);
        auto shape = extents;
        if (!element.is_fixed) {
            start[0] = detail::row_of(file_, element, k, main_.steps.at(file_, k));
            shape[0] = 1;
            extents.erase(extents.begin());
        }
        if ((!value.kind.is_integer() && value.kind.type_class != H5T_FLOAT) || extents.empty() || extents.size() > 2)
            refuse_shape(value, extents);
        for (const auto extent : extents)
            if (extent == 0 || extent > 3) refuse_shape(value, extents);
        numbers.resize(static_cast<std::size_t>(extents.size() == 2 ? extents[0] * extents[1] : extents[0]));
        detail::read_hdf5(file_, value, start, shape, H5T_NATIVE_DOUBLE, numbers.data());
        return numbers;
    }
    [[noreturn]] void refuse_shape(const detail::hdf5_dataset& value, const std::vector<hsize_t>& extents) const {
        file_.refuse(value.path, value.kind.text() + " " + detail::shown_extents(extents) + ", which is no box",
                     "H5MD asks for D or D x D numbers");
    }
    [[nodiscard]] restart_box read_box(std::size_t k) const {
        const auto path = group_path_ + "/box";
        if (!detail::has_hdf5_link(file_, group_.get(), "box", path))
            file_.refuse(group_path_, "there is no box", "H5MD asks for one");
        const auto group = detail::open_hdf5(file_, group_.get(), "box", path);
        const auto dimension = detail::read_hdf5_integers(file_, group.get(), "dimension", path);
        const auto boundary = detail::read_hdf5_texts(file_, group.get(), "boundary", path);
        if (dimension.size() != 1 || dimension[0] < 1 || dimension[0] > 3 ||
            boundary.size() != static_cast<std::size_t>(dimension[0]))
            file_.refuse(path, "dimension and boundary do not tell of a box of 1, 2 or 3 dimensions",
                         "check that the file is H5MD");
        restart_box box;
        box.dimension = boundary.size();
        for (std::size_t j = 0; j < box.dimension; ++j) {
            if (boundary[j] != "periodic" && boundary[j] != "none")
                file_.refuse(path, "the boundary is '" + boundary[j] + "'", "H5MD knows periodic and none");
            box.periodic[j] = boundary[j] == "periodic";
        }
        std::vector<hsize_t> extents;
        const auto edges = row_of_box(group.get(), path, "edges", k, extents);
        if (!edges.empty()) set_edges(box, path, edges, extents);
        set_corner(box.lo, box.dimension, row_of_box(group.get(), path, "lower", k, extents), path);
        for (std::size_t j = 0; j < box.dimension; ++j) box.hi[j] = box.lo[j] + box.lengths[j];
        set_corner(box.hi, box.dimension, row_of_box(group.get(), path, "upper", k, extents), path);
        return box;
    }
    void set_edges(restart_box& box, const std::string& path, const std::vector<double>& edges,
                   const std::vector<hsize_t>& extents) const {
        const auto d = box.dimension;
        for (const auto extent : extents)
            if (extent != d)
                file_.refuse(path + "/edges",
                             detail::shown_extents(extents) + " in " + std::to_string(d) + " dimensions",
                             "H5MD asks for D or D x D numbers");
        for (std::size_t k = 0, tilt = 0; k < d; ++k) {
            if (extents.size() == 1) {
                box.lengths[k] = edges[k];
                continue;
            }
            box.lengths[k] = edges[k * d + k];
            for (std::size_t j = 0; j < k; ++j) box.tilts[tilt++] = edges[k * d + j];
            for (std::size_t j = k + 1; j < d; ++j)
                if (edges[k * d + j] != 0)
                    file_.refuse(path + "/edges", "edge " + std::to_string(k) + " leaves the axes before it",
                                 "turn the box, so that its edges are (x, 0, 0), (xy, y, 0), (xz, yz, z)");
        }
    }
    void set_corner(vec<3>& corner, std::size_t d, const std::vector<double>& numbers, const std::string& path) const {
        if (numbers.empty()) return;
        if (numbers.size() != d)
            file_.refuse(path,
                         "a corner of " + std::to_string(numbers.size()) + " numbers in " + std::to_string(d) +
                             " dimensions",
                         "leave out lower and upper");
        for (std::size_t k = 0; k < d; ++k) corner[k] = numbers[k];
    }

    template <class Field>
    [[nodiscard]] source open_source(std::size_t k, Field) const {
        using traits = detail::hdf5_value<typename Field::value_type>;
        source from{detail::open_hdf5_element(file_, group_.get(), group_path_, std::string(Field::name)), 0};
        detail::check_hdf5_value<typename traits::scalar>(file_, from.element, traits::extents(), Field::unit);
        from.row = detail::row_of(file_, from.element, k, main_.steps.at(file_, k));
        return from;
    }
    /// The ids that stand for no particles.
    class gaps {
    public:
        gaps(const h5md_reader& reader, std::size_t k) {
            const auto& file = reader.file_;
            if (!detail::has_hdf5_link(file, reader.group_.get(), "id", reader.group_path_)) return;
            ids_.element = detail::open_hdf5_element(file, reader.group_.get(), reader.group_path_, "id");
            const auto& value = ids_.element.value;
            const auto properties = file.object(H5Dget_create_plist(value.object.get()), "read", value.path);
            H5D_fill_value_t told = H5D_FILL_VALUE_UNDEFINED;
            file.checked(H5Pfill_value_defined(properties.get(), &told), "read", value.path);
            if (told != H5D_FILL_VALUE_USER_DEFINED) return;
            if (!value.kind.is_integer() || value.extents.size() != (ids_.element.is_fixed ? 1 : 2))
                file.refuse(value.path,
                            value.kind.text() + " " + detail::shown_extents(value.extents) +
                                ", where an id per particle is wanted",
                            "check that the file is H5MD");
            type_ = value.kind.is_signed ? detail::hdf5_type_of<std::int64_t>() : detail::hdf5_type_of<std::uint64_t>();
            file.checked(H5Pget_fill_value(properties.get(), type_.get(), &none_), "read", value.path);
            ids_.row = detail::row_of(file, ids_.element, k, reader.main_.steps.at(file, k));
        }
        [[nodiscard]] bool exist() const noexcept { return static_cast<bool>(type_); }
        [[nodiscard]] const source& ids() const noexcept { return ids_; }
        /// Which of these are particles, as places from `first` on.
        void find_particles(const detail::hdf5_file& file, hsize_t first, std::size_t count,
                            std::vector<std::size_t>& there) {
            there.clear();
            if (exist()) {
                read_.resize(count);
                ids_.read(file, first, count, type_.get(), read_.data());
            }
            for (std::size_t i = 0; i < count; ++i)
                if (!exist() || read_[i] != none_) there.push_back(i);
        }

    private:
        source ids_;
        detail::hdf5_object type_;  // as it is read: there are gaps if there is one
        std::uint64_t none_ = 0;    // the bits of the number
        std::vector<std::uint64_t> read_;
    };

    template <auto... F, class Store>
    void read_frame(std::size_t k, Store& store, fields<F...>) const {
        gaps empty(*this, k);
        const std::array<source, sizeof...(F)> sources{open_source(k, F)...};
        const auto particles = sources[0].particles();
        for (const auto& from : sources) check_particles(from, particles);
        if (empty.exist()) check_particles(empty.ids(), particles);
        std::vector<std::size_t> there;
        std::vector<std::byte> bytes;
        for (hsize_t first = 0; first < particles; first += block) {
            const auto count = static_cast<std::size_t>((std::min)(hsize_t{block}, particles - first));
            empty.find_particles(file_, first, count, there);
            const auto at = store.add_owned(there.size());
            if (there.empty()) continue;
            std::size_t f = 0;
            (read_field(sources[f++], first, count, there, at, store, F, bytes), ...);
        }
    }
    void check_particles(const source& from, hsize_t particles) const {
        if (from.particles() != particles)
            file_.refuse(from.element.value.path,
                         std::to_string(from.particles()) + " particles, where others have " +
                             std::to_string(particles),
                         "check that the file is H5MD");
    }
    template <class Store, class Field>
    void read_field(const source& from, hsize_t first, std::size_t count, const std::vector<std::size_t>& there,
                    std::size_t at, Store& store, Field field, std::vector<std::byte>& bytes) const {
        using value_type = typename Field::value_type;
        using scalar = typename detail::hdf5_value<value_type>::scalar;
        constexpr auto size = sizeof(value_type);
        bytes.resize(count * size);
        // As a number, since HDF5 takes an enumeration for another one if its names differ.
        using read_type = std::conditional_t<std::is_same_v<scalar, bool>, signed char, scalar>;
        from.read(file_, first, count, detail::hdf5_type_of<read_type>().get(), bytes.data());
        const auto column = store[field];
        for (std::size_t i = 0; i < there.size(); ++i) {
            const auto* start = bytes.data() + there[i] * size;
            if constexpr (std::is_same_v<scalar, bool>)
                for (std::size_t j = 0; j < size; ++j)
                    if (start[j] > std::byte{1})
                        file_.refuse(from.element.value.path,
                                     "a value other than FALSE and TRUE, of particle " +
                                         std::to_string(first + there[i]),
                                     "name a field of a number");
            value_type value{};
            std::memcpy(&value, start, size);
            column[at + i] = value;
        }
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

    detail::hdf5_file file_;  // first, so that it is closed last
    std::string group_path_;
    detail::hdf5_object group_;
    detail::hdf5_element main_;  // whose frames are those of the file
    detail::hdf5_series_of<double> times_;
};

}  // namespace tsubu

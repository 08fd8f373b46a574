// SPDX-License-Identifier: MIT
/// @file
/// h5md_writer: a trajectory as an HDF5 file in the layout of H5MD 1.1.
#pragma once

#include <tsubu/io/detail/hdf5_frames.hpp>
#include <tsubu/io/detail/hdf5_library.hpp>
#include <tsubu/io/detail/hdf5_type.hpp>
#include <tsubu/io/h5md_options.hpp>
#include <tsubu/io/restart_state.hpp>
#include <tsubu/store/field.hpp>

#include <algorithm>    // std::min
#include <array>        // std::array
#include <concepts>     // std::integral
#include <cstddef>      // std::byte, std::size_t
#include <cstdint>      // std::int64_t
#include <cstring>      // std::memcpy
#include <string>       // std::string, std::to_string
#include <string_view>  // std::string_view
#include <tuple>        // std::tuple_size
#include <type_traits>  // std::is_same_v, std::remove_cv_t
#include <utility>      // std::move
#include <vector>       // std::vector

namespace tsubu {
namespace detail {

/// A box that H5MD can tell of: straight or tilted, of 1, 2 or 3 edges.
template <class Box>
concept h5md_box = requires(const Box& box) {
    restart_box(box);
    requires(requires { box.edge(0); } || requires { box.real_axis(0); });
};
template <class Box>
inline constexpr bool is_tilted_box = requires { typename Box::tilts; };

/// A name that stands for itself in a path, and for nothing else in a group of particles.
[[nodiscard]] constexpr bool is_h5md_name(std::string_view name) noexcept {
    return !name.empty() && name != "." && name != ".." && name != "box" && name.find('/') == std::string_view::npos &&
           name.find('\0') == std::string_view::npos;
}
template <auto... F>
[[nodiscard]] constexpr bool have_own_names(fields<F...>) noexcept {
    const std::array<std::string_view, sizeof...(F)> names{std::remove_cv_t<decltype(F)>::name...};
    for (std::size_t i = 0; i < names.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (names[i] == names[j]) return false;
    return true;
}
template <auto... F>
[[nodiscard]] constexpr bool has_field_named(fields<F...>, std::string_view name) noexcept {
    return ((std::remove_cv_t<decltype(F)>::name == name) || ...);
}
/// What the dimension of the box has to be: that of these fields, if they are there.
template <class Field, std::size_t D>
[[nodiscard]] constexpr bool has_dimension() noexcept {
    if constexpr (Field::name == "position" || Field::name == "image")
        return requires { requires std::tuple_size<typename Field::value_type>::value == D; };
    else
        return true;
}
template <class Field>
[[nodiscard]] constexpr bool is_id_type() noexcept {
    using value_type = typename Field::value_type;
    return Field::name != "id" || (std::integral<value_type> && !std::is_same_v<value_type, bool>);
}

}  // namespace detail

/// Of fields<...> only: the set that is written names each of them.
template <class Fields>
class h5md_writer;

/// A trajectory that grows by one frame after the other, for whoever reads HDF5: h5py, MDAnalysis, VMD ...
///
///     using set = tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::velocity<3>, tsubu::radius>;
///     tsubu::h5md_writer<set> file("run.h5", box, {.author = "A. Author"});
///     file.append(step, time, g, box);
///
/// Each field is the element /particles/<group>/<its name>, with its unit. Values are written as they are, bit for bit:
/// H5MD takes a position for any image of its particle, and `image` beside it tells which. A bool is an enumeration of
/// FALSE and TRUE, what h5py makes of it; an enumeration is its number.
///
/// The number of particles may change if the set has tsubu::id. A frame is as long as the longest one until then, and
/// its end is filled: ids with -1, or the greatest number if unsigned, floating-point numbers with NaN, others with 0.
/// H5MD takes such ids for no particles. Without ids a particle is the place that it has, so the order must stay, too.
///
/// After append the file is whole: a program that is killed later leaves what it has appended. Killed within append, it
/// may, rarely, leave a file that cannot be read, and so may a failure of power: keep restart files besides. While the
/// file is open, other programs cannot open it.
///
/// Several ranks: this is serial HDF5. Each rank writes its own file, or one of them collects the particles, in the
/// order of their ids if the file shall not depend on the number of ranks.
///
/// Bytes:   per frame those of the fields, up to an eighth more (16 particles at least), and 88 of box, step and time.
/// Memory:  8192 particles of a field, at most 1 MB, and as much in HDF5 for each field.
/// Threads: one at a time, of all that use HDF5 in this program.
/// Source:  H5MD 1.1, and its module units 1.0.
///
/// @tparam Fields  fields<...> of numbers, enumerations, bools, and std::arrays of them.
template <auto... F>
class h5md_writer<fields<F...>> {
    using set = fields<F...>;
    static_assert(sizeof...(F) > 0, "an H5MD file needs a field");
    static_assert(
        (detail::hdf5_value<typename std::remove_cv_t<decltype(F)>::value_type>::exists && ...),
        "an H5MD file takes numbers of up to 64 bits and std::arrays of them: no list_of, bonus_of or records");
    static_assert((detail::is_h5md_name(std::remove_cv_t<decltype(F)>::name) && ...),
                  "the name of a field in an H5MD file is not empty, not box, and has no /");
    static_assert(detail::have_own_names(set{}), "two fields of an H5MD file have the same name");
    static_assert((detail::is_id_type<std::remove_cv_t<decltype(F)>>() && ...),
                  "the field id of an H5MD file is an integer");
    static_assert(!detail::has_field_named(set{}, "image") || detail::has_field_named(set{}, "position"),
                  "H5MD asks for the position of what has an image; name it in the set");
    static constexpr bool has_ids = detail::has_field_named(set{}, "id");

public:
    /// Makes the file. @param box  a domain or a triclinic_box; the boxes of the frames are of its kind
    /// @throws input_error if the file exists and may not be replaced; file_error if the folder does not exist, ...
    template <detail::h5md_box Box>
    h5md_writer(std::string path, const Box& box, const h5md_options& options = {})
        : h5md_writer(std::move(path), restart_box(box), detail::is_tilted_box<Box>, options) {}

    [[nodiscard]] const std::string& path() const noexcept { return frames_.file().path(); }
    /// How many frames the file holds.
    [[nodiscard]] std::size_t frames() const noexcept { return frames_.frames(); }

    /// Adds the owned particles of a store as a frame.
    /// @param time  [s]
    /// @throws input_error if the step is not after the last one, the time is before it or not finite, the box of
    ///         another kind, or the number of particles another without ids to tell; file_error if the disk is full.
    /// Strong guarantee: room for the frame is asked for before anything is written. Only where the file system cannot
    /// tell (no fallocate), or the disk breaks, HDF5 may not be able to go on, nor to keep what was there.
    template <class Store, detail::h5md_box Box>
    void append(std::int64_t step, double time, const Store& store, const Box& box) {
        static_assert((Store::template has<std::remove_cv_t<decltype(F)>> && ...),
                      "the store lacks a field that is to be written");
        static_assert((detail::has_dimension<std::remove_cv_t<decltype(F)>, Box::dimension>() && ...),
                      "position and image have as many numbers as the box has dimensions");
        const detail::quiet_hdf5 quiet;
        const restart_box numbers(box);
        frames_.check(step, time, numbers, detail::is_tilted_box<Box>);
        const auto count = store.owned_count();
        if (!has_ids && frames() != 0 && count != frames_.most_particles())
            frames_.file().refuse("",
                                  std::to_string(count) + " particles after " +
                                      std::to_string(frames_.most_particles()),
                                  "add tsubu::id to the fields: H5MD tells by ids which places of a frame are empty");
        (check_ids(store, F), ...);
        std::size_t planned = 0;
        (frames_.plan(frames_.series(planned++), sizeof(typename decltype(F)::value_type), count), ...);
        frames_.append(step, time, numbers, count, [&] {
            std::size_t k = 0;
            (write(store, F, frames_.series(k++)), ...);
        });
    }
    /// Nothing can be appended after. The destructor does it too, but says nothing. @throws file_error
    void close() {
        const detail::quiet_hdf5 quiet;
        frames_.close();
    }

private:
    h5md_writer(std::string path, const restart_box& box, bool is_tilted, const h5md_options& options,
                const detail::quiet_hdf5& = {})
        : frames_(std::move(path), sizeof...(F), box, is_tilted, options) {}

    template <class Store, class Field>
    void check_ids([[maybe_unused]] const Store& store, Field field) const {
        if constexpr (Field::name == "id") {
            const auto ids = store[field];
            constexpr auto none = detail::hdf5_fill<typename Field::value_type>(true);
            for (std::size_t i = 0; i < store.owned_count(); ++i)
                if (ids[i] == none)
                    frames_.file().refuse("", "particle " + std::to_string(i) + " has the id " + std::to_string(none),
                                          "this id stands for no particle; give it another one");
        }
    }
    template <class Store, class Field>
    void write(const Store& store, Field field, detail::hdf5_series& series) {
        using value_type = typename Field::value_type;
        using traits = detail::hdf5_value<value_type>;
        using scalar = typename traits::scalar;
        const auto type = detail::hdf5_type_of<scalar>();
        const auto count = store.owned_count();
        if (!series.values) {
            constexpr auto fill = detail::hdf5_fill<scalar>(Field::name == "id");
            frames_.make_series(series, Field::name, Field::unit, type.get(), traits::extents(), &fill);
        }
        frames_.extend(series);
        const auto column = store[field];
        std::vector<std::byte> block((std::min)(series.block, count) * sizeof(value_type));
        for (std::size_t first = 0; first < count; first += series.block) {
            const auto n = (std::min)(series.block, count - first);
            for (std::size_t i = 0; i < n; ++i) {
                const value_type value = column[first + i];
                std::memcpy(block.data() + i * sizeof(value_type), &value, sizeof(value_type));
            }
            frames_.write(series, first, n, type.get(), block.data());
        }
    }

    detail::h5md_frames frames_;
};

}  // namespace tsubu

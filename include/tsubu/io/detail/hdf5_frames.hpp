// SPDX-License-Identifier: MIT
/// @file
/// A particles group of H5MD that is being written, frame by frame.
#pragma once

#include <tsubu/core/shown.hpp>
#include <tsubu/io/detail/hdf5_attribute.hpp>
#include <tsubu/io/detail/hdf5_library.hpp>
#include <tsubu/io/detail/hdf5_disk_space.hpp>
#include <tsubu/io/detail/hdf5_unit.hpp>
#include <tsubu/io/h5md_options.hpp>
#include <tsubu/io/restart_state.hpp>
#include <tsubu/version.hpp>

#include <algorithm>    // std::clamp, std::max, std::min
#include <array>        // std::array
#include <cmath>        // std::isfinite
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int32_t, std::int64_t
#include <cstdio>       // std::remove
#include <limits>       // std::numeric_limits
#include <string>       // std::string, std::to_string
#include <string_view>  // std::string_view
#include <utility>      // std::move
#include <vector>       // std::vector

namespace tsubu::detail {

// What a file looks like, with F frames and at most N particles in one of them:
//
//     /h5md                      +-- version 1.1, author, creator, modules/units
//     /particles/<group>/box     +-- dimension, boundary
//                        |-- edges     step [F], time [F], value [F][D], or [F][D][D] of a tilted box
//                        |-- lower, upper                  value [F][D]: the corners, of which H5MD does not tell
//                       /id            step, time, value [F][N]
//                       /position      step, time, value [F][N][D]
//                       ...
//
// There is one step and one time; all others are hard links to them, which H5MD asks for. N grows with the largest
// frame. The places of a frame beyond its own particles are never written: there HDF5 reads the fill value, of an id
// one that no particle has.
//
// A frame is there once `step` has grown, which comes last, after all else is flushed. Between two frames nothing waits
// to be written, and within one HDF5's cache of metadata is so large that it writes nothing by itself: a program that
// is killed while it computes leaves all frames that it has appended. Only within those flushes can a kill tear what
// HDF5 notes of a dataset: 2 of 500 programs that did nothing but append, killed at random, left a file with a field
// that could not be read. (SWMR, which writes in an order that nothing tears, leaves a mark of an open file, which
// others refuse.) The format is that of HDF5 1.8, which has no such marks.

/// One value per frame, or one per particle and frame.
struct hdf5_series {
    hdf5_object values;
    std::string path;              ///< in the file
    std::vector<hsize_t> extents;  ///< of the value of one particle, or of one frame
    bool per_particle = false;
    hsize_t bytes = 0;      ///< of the value of one particle
    hsize_t particles = 1;  ///< in a chunk
    std::size_t block = 1;  ///< how many particles are written in one go
};

class h5md_frames {
public:
    /// Makes the file, with all that does not wait for particles. @throws file_error, input_error
    /// @param fields  how many series per particle there will be
    h5md_frames(std::string path, std::size_t fields, const restart_box& box, bool is_tilted,
                const h5md_options& options)
        : file_("h5md_writer", std::move(path)),
          box_(box),
          is_tilted_(is_tilted),
          group_path_("/particles/" + options.group),
          series_(fields) {
        check_name(options.group);
        create(options);
        try {
            reserve_bytes(metadata_bytes);
            write_metadata(options);
            const auto particles = make_hdf5_group(file_, file_.get(), "particles", "/particles");
            group_ = make_hdf5_group(file_, particles.get(), options.group, group_path_);
            make_box();
            flush();
        } catch (...) {
            close_all();
            static_cast<void>(hdf5_object(file_.release()));
            std::remove(file_.path().c_str());
            throw;
        }
    }
    h5md_frames(h5md_frames&&) = default;
    h5md_frames& operator=(h5md_frames&&) = delete;
    ~h5md_frames() {
        if (!file_.is_open()) return;
        close_all();
        static_cast<void>(hdf5_object(file_.release()));
        return_disk_space(file_.path());
    }
    [[nodiscard]] hdf5_series& series(std::size_t k) noexcept { return series_[k]; }

    [[nodiscard]] const hdf5_file& file() const noexcept { return file_; }
    [[nodiscard]] std::size_t frames() const noexcept { return static_cast<std::size_t>(frames_); }
    /// The most in one frame.
    [[nodiscard]] std::size_t most_particles() const noexcept { return static_cast<std::size_t>(most_); }

    /// What has to hold before anything is written. @throws input_error
    void check(std::int64_t step, double time, const restart_box& box, bool is_tilted) const {
        if (!file_.is_open()) file_.refuse("", "the file is closed", "append before close()");
        if (is_broken_) file_.refuse("", "a frame before this one could not be taken back", "write a new file");
        if (frames_ != 0 && step <= last_step_)
            file_.refuse("", "step " + std::to_string(step) + " after step " + std::to_string(last_step_),
                         "append each step once, in their order");
        if (!std::isfinite(time))
            file_.refuse("", "the time " + shown(time) + " of step " + std::to_string(step), "give finite times");
        if (frames_ != 0 && time < last_time_)
            file_.refuse("", "the time " + shown(time) + " after " + shown(last_time_), "time goes forwards");
        if (box.dimension != box_.dimension || is_tilted != is_tilted_ || box.periodic != box_.periodic)
            file_.refuse(group_path_ + "/box", "the box has other dimensions, angles or periodic axes than the first",
                         "H5MD lets only its edges change: write a new file");
    }

    /// Writes a frame: body() writes the fields. If anything is thrown, the file is as before.
    template <class Body>
    void append(std::int64_t step, double time, const restart_box& box, std::size_t count, Body&& body) {
        reserve(count);
        const auto before = most_;
        try {
            most_ = (std::max)(most_, static_cast<hsize_t>(count));
            body();
            write_box(box);
            extend(time_, frames_ + 1);
            write(time_, 0, 1, H5T_NATIVE_DOUBLE, &time);
            flush();
            extend(step_, frames_ + 1);
            write(step_, 0, 1, H5T_NATIVE_INT64, &step);
            flush();
        } catch (...) {
            most_ = before;
            take_back();
            throw;
        }
        ++frames_;
        last_step_ = step;
        last_time_ = time;
    }

    /// How a series of a value per particle will lie, before the first frame is written.
    void plan(hdf5_series& series, std::size_t bytes, std::size_t count) const noexcept {
        if (series.values) return;
        // An eighth of the particles: what does not fill its last chunk is a small part. No chunk is above a megabyte,
        // so that other programs read it through HDF5's cache.
        const auto most = std::clamp((hsize_t{1} << 20) / bytes, hsize_t{1}, hsize_t{8192});
        series.per_particle = true;
        series.bytes = bytes;
        series.particles =
            std::clamp((count == 0 ? most : hsize_t{count} + 7) / 8, (std::min)(hsize_t{16}, most), most);
        series.block = static_cast<std::size_t>(series.particles * (most / series.particles));
    }
    /// An element with step, time and a value per particle. Precondition: it is planned. @param fill  of the type
    void make_series(hdf5_series& series, std::string_view name, std::string_view unit, hid_t type,
                     std::vector<hsize_t> extents, const void* fill) {
        make(series, group_.get(), group_path_, name, unit, type, std::move(extents),
             {frames_in_chunk(series), series.particles}, fill);
    }
    /// Makes room for the frame that is being written.
    void extend(hdf5_series& series) { extend(series, frames_ + 1); }
    /// The particles first .. first + count - 1 of that frame, or its one value.
    void write(const hdf5_series& series, std::size_t first, std::size_t count, hid_t type, const void* values) {
        const auto file_space = file_.object(H5Dget_space(series.values.get()), "write", series.path);
        std::vector<hsize_t> start{frames_};
        std::vector<hsize_t> shape{1};
        if (series.per_particle) {
            start.push_back(first);
            shape.push_back(count);
        }
        for (const auto extent : series.extents) {
            start.push_back(0);
            shape.push_back(extent);
        }
        const auto memory_space =
            file_.object(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), "write", series.path);
        file_.checked(H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr, shape.data(),
                                          nullptr),
                      "write", series.path);
        file_.checked(H5Dwrite(series.values.get(), type, memory_space.get(), file_space.get(), H5P_DEFAULT, values),
                      "write", series.path);
    }
    /// @throws file_error
    void close() {
        if (!file_.is_open()) return;
        close_all();
        file_.checked(H5Fclose(file_.release()), "close", {});
        return_disk_space(file_.path());
    }

private:
    void close_all() noexcept {
        for (auto& series : series_) series.values = {};
        for (auto* series : {&step_, &time_, &edges_, &lower_, &upper_}) series->values = {};
        group_ = {};
    }

    /// Chunks that would be small are of several frames.
    [[nodiscard]] static hsize_t frames_in_chunk(const hdf5_series& series) noexcept {
        return std::clamp(hsize_t{8192} / (series.particles * series.bytes), hsize_t{1}, hsize_t{128});
    }
    /// Room for a frame, and all that HDF5 may note of it.
    void reserve(std::size_t count) const {
        // A tree node of 5 kB has room for 64 chunks; when it is full, its half is moved.
        constexpr hsize_t node = 5120;
        hsize_t bytes = metadata_bytes;
        for (const auto& series : series_) {
            const auto chunks = (hsize_t{count} + series.particles - 1) / series.particles;
            bytes += chunks * series.particles * series.bytes * frames_in_chunk(series) + (chunks / 32 + 6) * node;
            if (!series.values) bytes += 2 * node;  // group, headers, unit
        }
        reserve_bytes(bytes);
    }
    void reserve_bytes(hsize_t bytes) const {
        hsize_t end = 0;
        void* descriptor = nullptr;
        file_.checked(H5Fget_filesize(file_.get(), &end), "ask the size of", {});
        file_.checked(H5Fget_vfd_handle(file_.get(), H5P_DEFAULT, &descriptor), "ask for the descriptor of", {});
        reserve_disk_space("h5md_writer", file_.path(), *static_cast<const int*>(descriptor), end, bytes);
    }

    static constexpr hsize_t metadata_bytes = hsize_t{1} << 17;  // of an empty file: 20 kB; of a frame's box: less
    static constexpr auto no_frame = std::numeric_limits<double>::quiet_NaN();

    void check_name(const std::string& name) const {
        if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos ||
            name.find('\0') != std::string::npos)
            file_.refuse("", "a group of the name '" + name + "'", "give a name without /");
    }
    void create(const h5md_options& options) {
        const auto access = file_.object(H5Pcreate(H5P_FILE_ACCESS), "make", {});
        file_.checked(H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18), "make", {});
        H5AC_cache_config_t cache{};
        cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
        file_.checked(H5Pget_mdc_config(access.get(), &cache), "make", {});
        constexpr std::size_t enough = std::size_t{64} << 20;  // bytes: of what one frame of 10^8 particles changes
        cache.set_initial_size = true;
        cache.initial_size = cache.max_size = enough;
        cache.min_clean_fraction = 0.01;  // else HDF5 writes early, to have clean room
        cache.incr_mode = H5C_incr__off;
        cache.flash_incr_mode = H5C_flash_incr__off;
        cache.decr_mode = H5C_decr__off;
        file_.checked(H5Pset_mdc_config(access.get(), &cache), "make", {});
        make_with_disk_space("h5md_writer", file_.path(), options.replace, metadata_bytes);
        file_.take(H5Fcreate(file_.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), "make");
    }
    void write_version(hid_t to, std::int32_t major, std::int32_t minor) {
        const std::array<std::int32_t, 2> version{major, minor};
        write_hdf5_attribute(file_, to, "version", H5T_NATIVE_INT32, {2}, version.data());
    }
    void write_metadata(const h5md_options& options) {
        const auto h5md = make_hdf5_group(file_, file_.get(), "h5md", "/h5md");
        write_version(h5md.get(), 1, 1);
        const auto author = make_hdf5_group(file_, h5md.get(), "author", "/h5md/author");
        write_hdf5_text(file_, author.get(), "name", options.author);
        if (!options.email.empty()) write_hdf5_text(file_, author.get(), "email", options.email);
        const auto creator = make_hdf5_group(file_, h5md.get(), "creator", "/h5md/creator");
        constexpr int version = TSUBU_VERSION;
        const auto own = std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
                         std::to_string(version % 100);
        write_hdf5_text(file_, creator.get(), "name", options.creator.empty() ? "tsubu" : options.creator);
        write_hdf5_text(file_, creator.get(), "version", options.creator.empty() ? own : options.creator_version);
        const auto modules = make_hdf5_group(file_, h5md.get(), "modules", "/h5md/modules");
        const auto units = make_hdf5_group(file_, modules.get(), "units", "/h5md/modules/units");
        write_version(units.get(), 1, 0);
        write_hdf5_long_text(file_, units.get(), "system", "SI");
    }
    void make_box() {
        const auto path = group_path_ + "/box";
        const auto box = make_hdf5_group(file_, group_.get(), "box", path);
        const auto d = static_cast<hsize_t>(box_.dimension);
        const auto dimension = static_cast<std::int32_t>(d);
        write_hdf5_attribute(file_, box.get(), "dimension", H5T_NATIVE_INT32, {}, &dimension);
        constexpr std::size_t length = 8;  // of "periodic"
        std::string boundary;
        for (std::size_t k = 0; k < box_.dimension; ++k) {
            boundary += box_.periodic[k] ? "periodic" : "none";
            boundary.resize((k + 1) * length);
        }
        const auto text = hdf5_text_type(file_, length, true);
        write_hdf5_attribute(file_, box.get(), "boundary", text.get(), {d}, boundary.data());
        // The one step and the one time: those of the edges, since every file has them.
        constexpr hsize_t frames = 64;  // in a chunk: a kilobyte or so
        make(edges_, box.get(), path, "edges", "m", H5T_NATIVE_DOUBLE,
             is_tilted_ ? std::vector<hsize_t>{d, d} : std::vector<hsize_t>{d}, {frames}, &no_frame);
        make(lower_, box.get(), path, "lower", "m", H5T_NATIVE_DOUBLE, {d}, {frames}, &no_frame);
        make(upper_, box.get(), path, "upper", "m", H5T_NATIVE_DOUBLE, {d}, {frames}, &no_frame);
    }
    void write_box(const restart_box& box) {
        const auto d = (std::min)(box.dimension, std::size_t{3});
        std::array<double, 9> edges{};
        for (std::size_t k = 0; k < d; ++k) edges[is_tilted_ ? k * d + k : k] = box.lengths[k];
        if (is_tilted_) {  // rows (lx, 0, 0), (xy, ly, 0), (xz, yz, lz), or (lx, 0), (xy, ly)
            edges[d] = box.tilts[0];
            if (d == 3) {
                edges[6] = box.tilts[1];
                edges[7] = box.tilts[2];
            }
        }
        for (auto* series : {&edges_, &lower_, &upper_}) extend(*series, frames_ + 1);
        write(edges_, 0, 1, H5T_NATIVE_DOUBLE, edges.data());
        write(lower_, 0, 1, H5T_NATIVE_DOUBLE, box.lo.data());
        write(upper_, 0, 1, H5T_NATIVE_DOUBLE, box.hi.data());
    }

    /// An element of no frame yet; nothing of it is left if that fails.
    void make(hdf5_series& series, hid_t parent, const std::string& parent_path, std::string_view name,
              std::string_view unit, hid_t type, std::vector<hsize_t> extents, std::vector<hsize_t> chunk,
              const void* fill) {
        const std::string called(name);
        const auto path = parent_path + "/" + called;
        const auto element = make_hdf5_group(file_, parent, called, path);
        try {
            if (!step_.values) {
                make_dataset(step_, element.get(), path + "/step", "step", "", H5T_NATIVE_INT64, {512}, nullptr);
                make_dataset(time_, element.get(), path + "/time", "time", "s", H5T_NATIVE_DOUBLE, {512}, nullptr);
            } else {
                link(step_, element.get(), "step", path);
                link(time_, element.get(), "time", path);
            }
            series.extents = std::move(extents);
            chunk.insert(chunk.end(), series.extents.begin(), series.extents.end());
            make_dataset(series, element.get(), path + "/value", "value", unit, type, chunk, fill);
        } catch (...) {
            series.values = {};
            const quiet_hdf5 quiet;
            H5Ldelete(parent, called.c_str(), H5P_DEFAULT);
            throw;
        }
    }
    void link(const hdf5_series& from, hid_t to, const char* name, const std::string& path) {
        file_.checked(H5Lcreate_hard(group_.get(), from.path.c_str(), to, name, H5P_DEFAULT, H5P_DEFAULT), "link",
                      path + "/" + name);
    }
    /// Of no frame; the first extent, and that of the particles, may grow.
    void make_dataset(hdf5_series& series, hid_t parent, const std::string& path, const char* name,
                      std::string_view unit, hid_t type, const std::vector<hsize_t>& chunk, const void* fill) {
        series.path = path;
        auto extents = chunk;
        auto most = chunk;
        extents[0] = 0;
        most[0] = H5S_UNLIMITED;
        if (series.per_particle && chunk.size() > 1) {
            extents[1] = most_;
            most[1] = H5S_UNLIMITED;
        }
        const auto space =
            file_.object(H5Screate_simple(static_cast<int>(chunk.size()), extents.data(), most.data()), "make", path);
        const auto properties = file_.object(H5Pcreate(H5P_DATASET_CREATE), "make", path);
        file_.checked(H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()), "make", path);
        if (fill != nullptr) file_.checked(H5Pset_fill_value(properties.get(), type, fill), "make", path);
        // No cache of chunks: each is written once, and what cannot be written is told at once.
        const auto access = file_.object(H5Pcreate(H5P_DATASET_ACCESS), "make", path);
        file_.checked(H5Pset_chunk_cache(access.get(), 0, 0, H5D_CHUNK_CACHE_W0_DEFAULT), "make", path);
        auto made =
            file_.object(H5Dcreate2(parent, name, type, space.get(), H5P_DEFAULT, properties.get(), access.get()),
                         "make", path);
        if (!unit.empty()) write_hdf5_long_text(file_, made.get(), "unit", h5md_unit(unit));
        series.values = std::move(made);
    }
    [[nodiscard]] std::vector<hsize_t> extents_at(const hdf5_series& series, hsize_t frames) const {
        std::vector<hsize_t> extents{frames};
        if (series.per_particle) extents.push_back(most_);
        extents.insert(extents.end(), series.extents.begin(), series.extents.end());
        return extents;
    }
    void extend(hdf5_series& series, hsize_t frames) {
        file_.checked(H5Dset_extent(series.values.get(), extents_at(series, frames).data()), "extend", series.path);
    }
    void take_back() noexcept {
        const auto shrink = [&](const hdf5_series& series) {
            if (series.values && H5Dset_extent(series.values.get(), extents_at(series, frames_).data()) < 0)
                is_broken_ = true;
        };
        try {
            for (const auto* series : {&step_, &time_, &edges_, &lower_, &upper_}) shrink(*series);
            for (const auto& series : series_) shrink(series);
        } catch (...) {  // no memory for the extents
            is_broken_ = true;
        }
        H5Eclear2(H5E_DEFAULT);
    }
    void flush() { file_.checked(H5Fflush(file_.get(), H5F_SCOPE_GLOBAL), "write", {}); }

    hdf5_file file_;  // first, so that it is closed last
    restart_box box_;
    bool is_tilted_;
    bool is_broken_ = false;
    std::string group_path_;
    hdf5_object group_;
    hdf5_series step_, time_, edges_, lower_, upper_;
    std::vector<hdf5_series> series_;
    hsize_t frames_ = 0;
    hsize_t most_ = 0;
    std::int64_t last_step_ = 0;
    double last_time_ = 0;
};

}  // namespace tsubu::detail

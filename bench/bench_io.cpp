// SPDX-License-Identifier: MIT
/// @file
/// How fast particles come from files and go to files, beside fscanf and fprintf, and beside moving the same bytes.
///
/// Rows, N the number of particles:
///
///     io/read/STYLE/tsubu/N:1000000        read_lammps into a store; STYLE: atomic, sphere, full, full_lammps
///     io/read/STYLE/fscanf/N:1000000       the same numbers into the same number of arrays
///     io/read/STYLE/plain/N:1000000        read() of the file, a mebibyte at a time
///     io/write/full/tsubu | fprintf | plain/N:...             write_lammps, "%.17g", write() of the same bytes
///     io/restart_write/soa/tsubu | plain/N:...                write_restart, write() of the same bytes
///     io/restart_read/soa/tsubu | plain/N:...                 read_restart, read() of the file into memory
///     io/vtk_write/soa/tsubu | plain/N:...                    write_vtp, write() of the same bytes
///
/// All have the counters bytes (of the file), bytes_per_second and items_per_second (particles).
///
/// Ids are in random order. Velocities stand in the order of the atoms, as LAMMPS writes them, in atomic, sphere and
/// full_lammps; in another one in full. Of style full a particle has a bond; bonds are in random order. Numbers have
/// the shortest form that reads back exactly, in full_lammps that of LAMMPS: "%.16e".
///
/// A group is one style or kind of file; its contenders run in random order. Files lie in memory (/dev/shm) where there
/// is such a place: what is measured is the library, not the disk.

#include "support/command_line.hpp"
#include "support/groups.hpp"
#include "support/registered.hpp"

#include <tsubu/core/random.hpp>
#include <tsubu/io/lammps_data_file.hpp>
#include <tsubu/io/restart.hpp>
#include <tsubu/io/vtk.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>     // std::min
#include <array>         // std::array
#include <charconv>      // std::to_chars
#include <cinttypes>     // PRId64, SCNd64
#include <cstddef>       // std::size_t
#include <cstdint>       // std::int32_t, std::int64_t
#include <cstdio>        // std::FILE, std::fprintf, std::fscanf, std::snprintf
#include <cstdlib>       // EXIT_SUCCESS
#include <filesystem>    // std::filesystem
#include <functional>    // std::function
#include <memory>        // std::make_shared
#include <stdexcept>     // std::runtime_error
#include <string>        // std::string
#include <system_error>  // std::error_code
#include <type_traits>   // std::remove_cvref_t
#include <utility>       // std::swap
#include <vector>        // std::vector

#include <fcntl.h>   // open
#include <unistd.h>  // close, getpid, read, write

namespace bench {
namespace {

using tsubu::vec;

constexpr std::size_t piece = std::size_t{1} << 20;

using atomic_fields = tsubu::fields<tsubu::id, tsubu::species, tsubu::position<3>, tsubu::velocity<3>>;
using sphere_fields = tsubu::fields<tsubu::id, tsubu::species, tsubu::position<3>, tsubu::velocity<3>,
                                    tsubu::angular_velocity<3>, tsubu::radius, tsubu::density>;
using full_fields = tsubu::fields<tsubu::id, tsubu::species, tsubu::position<3>, tsubu::velocity<3>, tsubu::molecule,
                                  tsubu::charge, tsubu::bonds>;
using full_store = tsubu::particle_store<full_fields>;

// ---------------------------------------------------------------------------------------------------------------
// Files

/// A file of its own, which goes with its object.
class scratch_file {
public:
    scratch_file() {
        static int last = 0;
        std::error_code none;
        const bool in_memory = std::filesystem::is_directory("/dev/shm", none) && ::access("/dev/shm", W_OK) == 0;
        path_ = (in_memory ? std::string("/dev/shm") : std::filesystem::temp_directory_path().string()) +
                "/tsubu_bench_" + std::to_string(::getpid()) + "_" + std::to_string(++last);
    }
    scratch_file(const scratch_file&) = delete;
    ~scratch_file() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] std::size_t bytes() const { return static_cast<std::size_t>(std::filesystem::file_size(path_)); }

private:
    std::string path_;
};

[[noreturn]] void fail(const std::string& path) {
    throw std::runtime_error(path + ": cannot be read or written; is there room?");
}

/// A file of the system, in pieces.
class plain_file {
public:
    plain_file(const std::string& path, int flags) : path_(path), descriptor_(::open(path.c_str(), flags, 0666)) {
        if (descriptor_ < 0) fail(path_);
    }
    plain_file(const plain_file&) = delete;
    ~plain_file() { ::close(descriptor_); }
    /// @return how much came; 0 at the end.
    std::size_t read(char* to, std::size_t count) {
        const auto got = ::read(descriptor_, to, count);
        if (got < 0) fail(path_);
        return static_cast<std::size_t>(got);
    }
    void write(const char* from, std::size_t count) {
        while (count != 0) {
            const auto written = ::write(descriptor_, from, (std::min)(count, piece));
            if (written <= 0) fail(path_);
            from += written;
            count -= static_cast<std::size_t>(written);
        }
    }

private:
    std::string path_;
    int descriptor_;
};

std::string content(const std::string& path) {
    std::string bytes(static_cast<std::size_t>(std::filesystem::file_size(path)), ' ');
    plain_file file(path, O_RDONLY);
    std::size_t at = 0;
    while (const auto got = file.read(bytes.data() + at, bytes.size() - at)) at += got;
    return bytes;
}
void write_plainly(const std::string& path, const std::string& bytes) {
    plain_file(path, O_WRONLY | O_CREAT | O_TRUNC).write(bytes.data(), bytes.size());
}
void read_plainly(const std::string& path, std::string& room) {
    plain_file file(path, O_RDONLY);
    while (file.read(room.data(), room.size()) != 0) benchmark::ClobberMemory();
}

/// A file of the C library.
class c_file {
public:
    c_file(const std::string& path, const char* mode) : path_(path), file_(std::fopen(path.c_str(), mode)) {
        if (file_ == nullptr) fail(path_);
    }
    c_file(const c_file&) = delete;
    ~c_file() { static_cast<void>(std::fclose(file_)); }
    [[nodiscard]] std::FILE* get() const { return file_; }
    void expect(bool holds) const {
        if (!holds) fail(path_);
    }

private:
    std::string path_;
    std::FILE* file_;
};

// ---------------------------------------------------------------------------------------------------------------
// What is in them

/// Numbers as plain arrays; what fscanf fills.
struct arrays {
    std::vector<std::int64_t> ids;
    std::vector<std::int32_t> types;
    std::vector<vec<3>> x, v, w;
    std::vector<double> radii, densities, charges;
    std::vector<std::int64_t> molecules;
    std::vector<tsubu::term<2>> bonds;
};

void shuffle(std::vector<std::size_t>& order, std::uint64_t seed) {
    tsubu::random_stream random(seed);
    for (auto n = order.size(); n > 1; --n) std::swap(order[n - 1], order[random.below(n)]);
}
std::vector<std::size_t> shuffled(std::size_t count, std::uint64_t seed) {
    std::vector<std::size_t> order(count);
    for (std::size_t k = 0; k < count; ++k) order[k] = k;
    shuffle(order, seed);
    return order;
}

arrays make_particles(std::size_t count) {
    arrays g;
    tsubu::random_stream random(6);
    const auto some = [&](double size) {
        return vec<3>{size * random.unit(), size * random.unit(), size * random.unit()};
    };
    for (const auto k : shuffled(count, 1)) {
        g.ids.push_back(static_cast<std::int64_t>(k) + 1);
        g.types.push_back(1 + static_cast<std::int32_t>(k % 3));
        g.x.push_back(some(100));
        g.v.push_back(some(2));
        g.w.push_back(some(2));
        g.radii.push_back(0.25 + random.unit() / 4);
        g.densities.push_back(2500 + random.unit());
        g.charges.push_back(random.unit() - 0.5);
        g.molecules.push_back(static_cast<std::int64_t>(k / 3));
    }
    for (const auto k : shuffled(count, 2)) {
        const auto one = static_cast<std::int64_t>(k) + 1;
        g.bonds.push_back({1, {one, one % static_cast<std::int64_t>(count) + 1}});
    }
    return g;
}

enum class form { shortest, lammps };

/// Text of numbers.
class writer_of_rows {
public:
    explicit writer_of_rows(form how) : how_(how) {}
    void put(const char* words) { text_ += words; }
    void put(std::int64_t n) { add(std::to_chars(room_, room_ + sizeof room_, n).ptr); }
    void put(double x) {
        add(how_ == form::shortest ? std::to_chars(room_, room_ + sizeof room_, x).ptr
                                   : room_ + std::snprintf(room_, sizeof room_, "%.16e", x));
    }
    void put(const vec<3>& x) {
        for (const auto one : x) put(one);
    }
    template <class... Numbers>
    void row(const Numbers&... numbers) {
        (put(numbers), ...);
        text_.back() = '\n';
    }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    void add(const char* end) {
        text_.append(room_, static_cast<std::size_t>(end - room_));
        text_ += ' ';
    }
    form how_;
    char room_[64];
    std::string text_;
};

std::string text_of(const arrays& g, tsubu::atom_style style, form how, const std::vector<std::size_t>& order) {
    writer_of_rows out(how);
    const auto n = static_cast<std::int64_t>(g.ids.size());
    out.put("bench\n\n");
    out.put(n), out.put("atoms\n3 atom types\n");
    if (style == tsubu::atom_style::full) out.put(n), out.put("bonds\n1 bond types\n");
    out.put("\n0 100 xlo xhi\n0 100 ylo yhi\n0 100 zlo zhi\n\nAtoms # ");
    out.put(std::string(tsubu::name_of(style)).c_str());
    out.put("\n\n");
    for (std::size_t i = 0; i < g.ids.size(); ++i) {
        const std::int64_t type = g.types[i];
        if (style == tsubu::atom_style::atomic)
            out.row(g.ids[i], type, g.x[i]);
        else if (style == tsubu::atom_style::sphere)
            out.row(g.ids[i], type, 2 * g.radii[i], g.densities[i], g.x[i]);
        else
            out.row(g.ids[i], g.molecules[i], type, g.charges[i], g.x[i]);
    }
    out.put("\nVelocities\n\n");
    for (const auto i : order)
        if (style == tsubu::atom_style::sphere)
            out.row(g.ids[i], g.v[i], g.w[i]);
        else
            out.row(g.ids[i], g.v[i]);
    if (style != tsubu::atom_style::full) return out.text();
    out.put("\nBonds\n\n");
    for (std::size_t k = 0; k < g.bonds.size(); ++k)
        out.row(static_cast<std::int64_t>(k) + 1, std::int64_t{g.bonds[k].type}, g.bonds[k].ids[0], g.bonds[k].ids[1]);
    return out.text();
}

// ---------------------------------------------------------------------------------------------------------------
// Contenders who read

/// Reads what text_of writes. It trusts the file, and finds ids, which lie dense, in an array.
arrays read_by_fscanf(const std::string& path, tsubu::atom_style style) {
    const c_file file(path, "r");
    auto* const f = file.get();
    std::int64_t n = 0;
    file.expect(std::fscanf(f, "%*s %" SCNd64 " atoms %*d atom types ", &n) == 1);
    if (style == tsubu::atom_style::full) file.expect(std::fscanf(f, "%*d bonds %*d bond types ") == 0);
    file.expect(std::fscanf(f, "%*f %*f xlo xhi %*f %*f ylo yhi %*f %*f zlo zhi Atoms # %*s ") == 0);
    const auto count = static_cast<std::size_t>(n);
    arrays g;
    g.ids.resize(count), g.types.resize(count), g.x.resize(count), g.v.resize(count);
    if (style == tsubu::atom_style::sphere) g.radii.resize(count), g.densities.resize(count), g.w.resize(count);
    if (style == tsubu::atom_style::full) g.molecules.resize(count), g.charges.resize(count), g.bonds.resize(count);
    std::vector<std::uint32_t> place(count + 1);
    for (std::size_t i = 0; i < count; ++i) {
        auto& x = g.x[i];
        int got = 0;
        if (style == tsubu::atom_style::atomic) {
            got = std::fscanf(f, "%" SCNd64 " %d %lf %lf %lf", &g.ids[i], &g.types[i], &x[0], &x[1], &x[2]);
        } else if (style == tsubu::atom_style::sphere) {
            double diameter = 0;
            got = std::fscanf(f, "%" SCNd64 " %d %lf %lf %lf %lf %lf", &g.ids[i], &g.types[i], &diameter,
                              &g.densities[i], &x[0], &x[1], &x[2]);
            g.radii[i] = diameter / 2;
        } else {
            got = std::fscanf(f, "%" SCNd64 " %" SCNd64 " %d %lf %lf %lf %lf", &g.ids[i], &g.molecules[i], &g.types[i],
                              &g.charges[i], &x[0], &x[1], &x[2]);
        }
        file.expect(got >= 5);
        place[static_cast<std::size_t>(g.ids[i])] = static_cast<std::uint32_t>(i);
    }
    file.expect(std::fscanf(f, " Velocities ") == 0);
    for (std::size_t k = 0; k < count; ++k) {
        std::int64_t name = 0;
        vec<3> v{};
        file.expect(std::fscanf(f, "%" SCNd64 " %lf %lf %lf", &name, &v[0], &v[1], &v[2]) == 4);
        const auto i = place[static_cast<std::size_t>(name)];
        g.v[i] = v;
        if (style != tsubu::atom_style::sphere) continue;
        auto& w = g.w[i];
        file.expect(std::fscanf(f, "%lf %lf %lf", &w[0], &w[1], &w[2]) == 3);
    }
    if (style != tsubu::atom_style::full) return g;
    file.expect(std::fscanf(f, " Bonds ") == 0);
    for (auto& one : g.bonds)
        file.expect(std::fscanf(f, "%*d %" SCNd64 " %" SCNd64 " %" SCNd64, &one.type, &one.ids[0], &one.ids[1]) == 3);
    return g;
}

template <class Store>
Store read_by_tsubu(const std::string& path) {
    Store g;
    tsubu::read_lammps(path, g);
    return g;
}

template <auto Field, class Store, class Values>
bool same_column(const Store& g, const Values& values) {
    if constexpr (Store::template has<std::remove_cvref_t<decltype(Field)>>) {
        const auto column = g[Field];
        for (std::size_t i = 0; i < values.size(); ++i)
            if (column[i] != values[i]) return false;
        return column.size() == values.size();
    }
    return true;
}
template <class Store>
bool same_particles(const Store& g, const arrays& all) {
    bool same = same_column<tsubu::id>(g, all.ids) && same_column<tsubu::species>(g, all.types) &&
                same_column<tsubu::position<3>>(g, all.x) && same_column<tsubu::velocity<3>>(g, all.v) &&
                same_column<tsubu::angular_velocity<3>>(g, all.w) && same_column<tsubu::radius>(g, all.radii) &&
                same_column<tsubu::density>(g, all.densities) && same_column<tsubu::charge>(g, all.charges) &&
                same_column<tsubu::molecule>(g, all.molecules);
    if constexpr (Store::template has<std::remove_cvref_t<decltype(tsubu::bonds)>>) {
        std::vector<std::size_t> of(all.ids.size() + 1);
        for (std::size_t i = 0; i < all.ids.size(); ++i) of[static_cast<std::size_t>(all.ids[i])] = i;
        for (const auto& one : all.bonds) {
            const auto list = g[tsubu::bonds][of[static_cast<std::size_t>(one.ids[0])]];
            same = same && list.size() == 1 && list[0] == one;
        }
    }
    return same;
}

// ---------------------------------------------------------------------------------------------------------------
// Groups

template <class Pass>
void measure(const std::string& name, std::size_t count, std::size_t bytes, Pass pass) {
    benchmark::RegisterBenchmark((name + "/N:" + std::to_string(count)).c_str(), [=](benchmark::State& state) {
        for (auto _ : state) {
            pass();
            benchmark::ClobberMemory();
        }
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
        state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
        state.counters["bytes"] = static_cast<double>(bytes);
    });
}
template <class Fields>
void run_read(const std::string& name, tsubu::atom_style style, form how, bool in_order, std::size_t count,
              row_reporter& report) {
    using store = tsubu::particle_store<Fields>;
    const auto file = std::make_shared<scratch_file>();
    {
        std::vector<std::size_t> order(count);
        for (std::size_t k = 0; k < count; ++k) order[k] = k;
        if (!in_order) shuffle(order, 3);
        write_plainly(file->path(), text_of(make_particles(count), style, how, order));
    }
    if (!same_particles(read_by_tsubu<store>(file->path()), read_by_fscanf(file->path(), style)))
        throw std::runtime_error("io/read/" + name + ": tsubu and fscanf differ; figures would be worthless");
    const auto bytes = file->bytes();
    measure("io/read/" + name + "/tsubu", count, bytes, [=] {
        const auto g = read_by_tsubu<store>(file->path());
        benchmark::DoNotOptimize(g.size());
    });
    measure("io/read/" + name + "/fscanf", count, bytes, [=] {
        const auto g = read_by_fscanf(file->path(), style);
        benchmark::DoNotOptimize(g.ids.data());
    });
    const auto room = std::make_shared<std::string>(piece, ' ');
    measure("io/read/" + name + "/plain", count, bytes, [=] { read_plainly(file->path(), *room); });
    run_registered(report);
}

std::shared_ptr<full_store> make_full(std::size_t count) {
    const auto from = make_particles(count);
    const auto g = std::make_shared<full_store>();
    for (std::size_t i = 0; i < count; ++i)
        g->push_back(tsubu::id = from.ids[i], tsubu::species = from.types[i], tsubu::position<3> = from.x[i],
                     tsubu::velocity<3> = from.v[i], tsubu::molecule = from.molecules[i],
                     tsubu::charge = from.charges[i]);
    tsubu::id_map<> where;
    where.rebuild(from.ids);
    for (const auto& one : from.bonds) tsubu::topology<tsubu::bonds, tsubu::newton_on>::insert(*g, where, one);
    return g;
}

const tsubu::lammps_header cube{.title = "bench", .lo = {0, 0, 0}, .hi = {100, 100, 100}};

void write_by_fprintf(const std::string& path, const full_store& g) {
    const c_file file(path, "w");
    auto* const f = file.get();
    std::fprintf(f, "bench\n\n%zu atoms\n3 atom types\n%zu bonds\n1 bond types\n\n", g.size(), g.size());
    std::fputs("0 100 xlo xhi\n0 100 ylo yhi\n0 100 zlo zhi\n\nAtoms # full\n\n", f);
    const auto ids = g[tsubu::id];
    const auto x = g[tsubu::position<3>];
    const auto v = g[tsubu::velocity<3>];
    for (std::size_t i = 0; i < g.size(); ++i)
        std::fprintf(f, "%" PRId64 " %" PRId64 " %d %.17g %.17g %.17g %.17g\n", ids[i], g[tsubu::molecule][i],
                     static_cast<int>(g[tsubu::species][i]), g[tsubu::charge][i], x[i][0], x[i][1], x[i][2]);
    std::fputs("\nVelocities\n\n", f);
    for (std::size_t i = 0; i < g.size(); ++i)
        std::fprintf(f, "%" PRId64 " %.17g %.17g %.17g\n", ids[i], v[i][0], v[i][1], v[i][2]);
    std::fputs("\nBonds\n\n", f);
    std::int64_t k = 0;
    for (std::size_t i = 0; i < g.size(); ++i)
        for (const auto& one : g[tsubu::bonds][i])
            std::fprintf(f, "%" PRId64 " %" PRId64 " %" PRId64 " %" PRId64 "\n", ++k, one.type, one.ids[0], one.ids[1]);
    file.expect(std::fflush(f) == 0);
}

std::string canonical(const std::string& path) {
    full_store g;
    const auto top = tsubu::read_lammps(path, g);
    std::string text;
    tsubu::lammps_writer out([&](std::string_view chunk) { text += chunk; }, {.canonical = true});
    out.write(g, top);
    return text;
}

void run_write(std::size_t count, row_reporter& report) {
    const auto g = make_full(count);
    const auto file = std::make_shared<scratch_file>();
    write_by_fprintf(file->path(), *g);
    const auto by_hand = canonical(file->path());
    const auto bytes_by_hand = file->bytes();
    tsubu::write_lammps(file->path(), *g, cube);
    if (canonical(file->path()) != by_hand)
        throw std::runtime_error("io/write: the files of tsubu and fprintf differ; figures would be worthless");
    const auto text = std::make_shared<std::string>(content(file->path()));
    measure("io/write/full/tsubu", count, text->size(), [=] { tsubu::write_lammps(file->path(), *g, cube); });
    measure("io/write/full/fprintf", count, bytes_by_hand, [=] { write_by_fprintf(file->path(), *g); });
    measure("io/write/full/plain", count, text->size(), [=] { write_plainly(file->path(), *text); });
    run_registered(report);
}

void run_restart(std::size_t count, row_reporter& report) {
    const auto g = make_full(count);
    const auto file = std::make_shared<scratch_file>();
    const auto other = std::make_shared<scratch_file>();
    tsubu::write_restart(file->path(), *g, full_fields{});
    const auto bytes = std::make_shared<std::string>(content(file->path()));
    const auto read = [=] {
        full_store h;
        tsubu::read_restart(file->path(), h, full_fields{});
        return h;
    };
    {
        const auto h = read();
        tsubu::write_restart(other->path(), h, full_fields{});
        if (content(other->path()) != *bytes)
            throw std::runtime_error("io/restart: what was written is not what is read; figures would be worthless");
    }
    measure("io/restart_write/soa/tsubu", count, bytes->size(),
            [=] { tsubu::write_restart(other->path(), *g, full_fields{}); });
    measure("io/restart_write/soa/plain", count, bytes->size(), [=] { write_plainly(other->path(), *bytes); });
    measure("io/restart_read/soa/tsubu", count, bytes->size(), [=] { benchmark::DoNotOptimize(read().size()); });
    measure("io/restart_read/soa/plain", count, bytes->size(),
            [=] { benchmark::DoNotOptimize(content(file->path()).data()); });
    run_registered(report);
}

void run_vtk(std::size_t count, row_reporter& report) {
    const auto g = make_full(count);
    const auto file = std::make_shared<scratch_file>();
    tsubu::write_vtp(file->path(), *g, tsubu::position<3>);
    const auto bytes = std::make_shared<std::string>(content(file->path()));
    measure("io/vtk_write/soa/tsubu", count, bytes->size(),
            [=] { tsubu::write_vtp(file->path(), *g, tsubu::position<3>); });
    measure("io/vtk_write/soa/plain", count, bytes->size(), [=] { write_plainly(file->path(), *bytes); });
    run_registered(report);
}

// ---------------------------------------------------------------------------------------------------------------
// The plan

std::vector<group> plan(extent how_much) {
    using tsubu::atom_style;
    std::vector<std::size_t> sizes = {100'000};
    if (how_much != extent::quick) sizes.push_back(1'000'000);
    if (how_much == extent::full) sizes.push_back(10'000'000);
    std::vector<group> groups;
    for (const auto n : sizes) {
        const auto add = [&](const std::string& name, double share, std::function<void(row_reporter&)> body) {
            groups.push_back({"io/" + name + "/N:" + std::to_string(n), share * (0.1 + static_cast<double>(n) * 1e-6),
                              std::move(body)});
        };
        add("read/atomic", 8,
            [=](auto& r) { run_read<atomic_fields>("atomic", atom_style::atomic, form::shortest, true, n, r); });
        add("read/sphere", 12,
            [=](auto& r) { run_read<sphere_fields>("sphere", atom_style::sphere, form::shortest, true, n, r); });
        add("read/full", 12,
            [=](auto& r) { run_read<full_fields>("full", atom_style::full, form::shortest, false, n, r); });
        add("read/full_lammps", 12,
            [=](auto& r) { run_read<full_fields>("full_lammps", atom_style::full, form::lammps, true, n, r); });
        add("write/full", 18, [=](auto& r) { run_write(n, r); });
        add("restart", 3, [=](auto& r) { run_restart(n, r); });
        add("vtk_write", 1, [=](auto& r) { run_vtk(n, r); });
    }
    return groups;
}

constexpr const char* usage =
    "bench_io [--quick | --full] [--only TEXT] [--benchmark_out=FILE.json] [--benchmark_...]\n"
    "  --quick     N = 1e5: some seconds\n"
    "  (neither)   N = 1e5, 1e6: about a minute and a half\n"
    "  --full      N = 1e7 as well: 8 GB of memory, half of it for files\n"
    "  --only TEXT only groups whose name contains it, such as io/read/full/N:1000000\n";

int run(const options& chosen) {
    return run_groups("bench_io", plan(chosen.how_much), chosen);
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
    return bench::run_program(argc, argv, "bench_io", bench::usage, false, bench::run);
}

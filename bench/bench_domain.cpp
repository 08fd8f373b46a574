// SPDX-License-Identifier: MIT
/// @file
/// Whose is x: how long a batch of points takes, how far a wrapped position drifts, and how many points a border policy
/// gives to no rank, or to two.
///
/// A group of times is one number of points: every scalar, border policy and operation holds its points at the same
/// time, and their repetitions run in random order, so that whatever disturbs the machine disturbs everyone alike.

#include "support/aligned_column.hpp"
#include "support/command_line.hpp"
#include "support/groups.hpp"
#include "support/plain_read.hpp"
#include "support/registered.hpp"

#include <tsubu/core/random.hpp>
#include <tsubu/domain/brick_decomposition.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>    // std::max
#include <array>        // std::array
#include <cmath>        // std::nextafter, std::remainder
#include <concepts>     // std::floating_point
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int64_t, std::uint64_t
#include <cstdio>       // std::fprintf, std::snprintf
#include <cstdlib>      // EXIT_SUCCESS, std::strtod
#include <functional>   // std::function
#include <limits>       // std::numeric_limits
#include <memory>       // std::make_shared
#include <span>         // std::span
#include <stdexcept>    // std::runtime_error
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <type_traits>  // std::make_unsigned_t
#include <utility>      // std::swap
#include <vector>       // std::vector

namespace bench {
namespace {

using tsubu::exact;
using tsubu::padded;
using coarse_lattice = tsubu::lattice<std::int32_t>;
using fine_lattice = tsubu::lattice<std::int64_t>;

template <class Type>
constexpr const char* name_of = nullptr;
template <>
constexpr const char* name_of<double> = "double";
template <>
constexpr const char* name_of<float> = "float";
template <>
constexpr const char* name_of<coarse_lattice> = "lattice32";
template <>
constexpr const char* name_of<fine_lattice> = "lattice64";
template <>
constexpr const char* name_of<exact> = "exact";
template <>
constexpr const char* name_of<padded> = "padded";

/// The box [lo, lo + size) of all axes alike.
template <std::size_t D, class Scalar, class Border = exact>
tsubu::domain<D, Scalar, Border> cube(double lo, double size, bool periodic, const Border& border = Border{}) {
    using box = tsubu::domain<D, Scalar, Border>;
    typename box::real_position_type from{};
    typename box::real_position_type to{};
    typename box::options with{{}, border};
    from.fill(static_cast<typename box::real_type>(lo));
    to.fill(static_cast<typename box::real_type>(lo + size));
    with.periodic.fill(periodic);
    return box(from, to, with);
}

/// A fraction of the box, in units of 2^-64 of it, as a position of a box that begins at 0 and has the length 1; the
/// scalar must have room for the bits.
template <class Scalar>
Scalar position_of(std::uint64_t fraction) {
    if constexpr (tsubu::is_lattice<Scalar>) {
        using Int = decltype(Scalar{}.value);
        constexpr auto lower_face = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::min());
        return {static_cast<Int>(static_cast<std::int64_t>(fraction ^ lower_face) >> (64 - 8 * sizeof(Int)))};
    } else {
        return static_cast<Scalar>(static_cast<double>(fraction) * 0x1p-64);
    }
}

// ---------------------------------------------------------------------------------------------------------------
// Times

constexpr std::array<std::size_t, 3> rank_grid = {2, 2, 2};  // 8 ranks
constexpr std::size_t asked_rank = 5;

/// Points in random order, all over the box, for questions that leave them where they are.
template <class Scalar>
struct still_points {
    std::array<aligned_column<Scalar>, 3> columns;
    std::vector<tsubu::vec<3, Scalar>> rows;
    aligned_column<unsigned char> mask;
    std::vector<tsubu::rank_t> owners;

    explicit still_points(std::size_t count) : rows(count), mask(count), owners(count) {
        tsubu::random_stream random(1);
        for (auto& row : rows)
            for (auto& coordinate : row) coordinate = position_of<Scalar>(random() & ~std::uint64_t{0} << 44);
        for (std::size_t k = 0; k < 3; ++k)
            for (const auto& row : rows) columns[k].push_back(row[k]);
    }
    [[nodiscard]] tsubu::points<3, const Scalar> as_columns() const {
        return typename tsubu::points<3, const Scalar>::columns{columns[0], columns[1], columns[2]};
    }
    [[nodiscard]] tsubu::points<3, const Scalar> as_rows() const { return rows; }
};

/// Points that have to be wrapped anew in each pass, without a pass that moves them back: there are two boxes, the
/// second half a box further along the first axis, and what one of them wraps is then outside the other.
///
///     first   |----a----|----b----|              a goes to c, or c to a; b is in both
///     second            |----b----|----c----|
///
/// No lattice point is ever outside: its pass only finds that out.
template <class Scalar>
class moving_points {
public:
    moving_points(std::size_t count, double outside) : shifts_(count) {
        tsubu::random_stream random(2);
        for (auto& column : columns_) column.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const bool moves = random.unit() < outside;
            moving_ += moves ? 1U : 0U;
            constexpr std::uint64_t digits = ~std::uint64_t{0} << 44;  // 2^-20: exact in every scalar, in both boxes
            constexpr std::uint64_t half = std::uint64_t{1} << 63;
            columns_[0][i] = position_of<Scalar>((random() & digits & ~half) | (moves ? 0 : half));
            for (std::size_t k = 1; k < 3; ++k) columns_[k][i] = position_of<Scalar>(random() & digits);
        }
    }
    /// @return how many points changed.
    template <class Border>
    std::size_t pass(const std::array<tsubu::domain<3, Scalar, Border>, 2>& boxes) {
        turn_ = 1 - turn_;
        using points = tsubu::points<3, Scalar>;
        return boxes[turn_].wrap(points(typename points::columns{columns_[0], columns_[1], columns_[2]}), shifts_);
    }
    [[nodiscard]] std::size_t expected_changes() const noexcept { return tsubu::is_lattice<Scalar> ? 0 : moving_; }

private:
    std::array<aligned_column<Scalar>, 3> columns_;
    std::vector<tsubu::image_shift<3>> shifts_;
    std::size_t moving_ = 0;
    std::size_t turn_ = 0;
};

template <class Scalar>
struct all_points {
    still_points<Scalar> still;
    moving_points<Scalar> few_outside, half_outside;

    explicit all_points(std::size_t count) : still(count), few_outside(count, .01), half_outside(count, .5) {}
};

constexpr std::size_t small_count = 200'000;  // up to here the caches may stay warm

/// @param touched  bytes read and written per point, at least
template <class Pass>
void measure(const std::string& name, std::size_t count, std::size_t touched, Pass pass) {
    const auto run = [=](benchmark::State& state) {
        if (count <= small_count) static_cast<void>(pass());
        for (auto _ : state) {
            static_cast<void>(pass());
            benchmark::ClobberMemory();
        }
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
        state.counters["bytes_per_point"] = static_cast<double>(touched);
    };
    benchmark::RegisterBenchmark((name + "/N:" + std::to_string(count)).c_str(), run);
}

[[noreturn]] void disagree(const std::string& what) {
    throw std::runtime_error(what + ": answers otherwise than point by point; its figures would be worthless");
}

/// Both storages and the single predicates must agree before any is measured. @throws std::runtime_error that names the
/// one.
template <class Scalar, class Border>
void compare_answers(const std::string& name, const tsubu::brick_decomposition<3, Scalar, Border>& bricks,
                     still_points<Scalar>& points) {
    const auto mine = bricks.subdomain(asked_rank);
    for (const bool in_rows : {false, true}) {
        mine.owns(in_rows ? points.as_rows() : points.as_columns(), points.mask);
        for (std::size_t i = 0; i < points.rows.size(); ++i)
            if ((points.mask[i] != 0) != mine.owns(points.rows[i]))
                disagree(name + (in_rows ? "owns_rows" : "owns_columns"));
    }
    bricks.owner(points.as_columns(), points.owners);
    for (std::size_t i = 0; i < points.rows.size(); ++i)
        if (points.owners[i] != bricks.owner(points.rows[i])) disagree(name + "owner_columns");
}

/// Everything that one scalar and border policy is measured at. `only_owns`: not the other operations.
template <class Scalar, class Border>
void add_contenders(const std::shared_ptr<all_points<Scalar>>& points, std::size_t count, bool only_owns) {
    const auto name = std::string("domain/time/") + name_of<Scalar> + "/" + name_of<Border> + "/";
    const tsubu::brick_decomposition<3, Scalar, Border> bricks(cube<3, Scalar, Border>(0, 1, true), rank_grid);
    compare_answers(name, bricks, points->still);

    constexpr auto row_bytes = 3 * sizeof(Scalar);
    const auto mine = bricks.subdomain(asked_rank);
    measure(name + "owns_columns", count, row_bytes + 1, [=] {
        mine.owns(points->still.as_columns(), points->still.mask);
        benchmark::DoNotOptimize(points->still.mask.data());
    });
    if (only_owns) return;
    measure(name + "owns_rows", count, row_bytes + 1, [=] {
        mine.owns(points->still.as_rows(), points->still.mask);
        benchmark::DoNotOptimize(points->still.mask.data());
    });
    measure(name + "owner_columns", count, row_bytes + sizeof(tsubu::rank_t), [=] {
        bricks.owner(points->still.as_columns(), points->still.owners);
        benchmark::DoNotOptimize(points->still.owners.data());
    });
    std::array boxes = {cube<3, Scalar, Border>(0, 1, true), cube<3, Scalar, Border>(0, 1, true)};
    if constexpr (!tsubu::is_lattice<Scalar>)
        boxes[1] = {{Scalar(.5), 0, 0}, {Scalar(1.5), 1, 1}, {{true, true, true}, Border{}}};
    for (const bool half : {false, true}) {
        const auto operation = std::string(half ? "wrap_half_columns" : "wrap_few_columns");
        const auto pass = [=] {
            auto& moving = half ? points->half_outside : points->few_outside;
            const auto changed = moving.pass(boxes);
            benchmark::DoNotOptimize(changed);
            return changed == moving.expected_changes();
        };
        if (!pass() || !pass()) disagree(name + operation);
        measure(name + operation, count, row_bytes, pass);
    }
}

template <class Scalar>
void add_scalar(std::size_t count, bool only_owns) {
    const auto points = std::make_shared<all_points<Scalar>>(only_owns ? 0 : count);
    if (only_owns) points->still = still_points<Scalar>(count);
    add_contenders<Scalar, exact>(points, count, only_owns);
    if constexpr (std::floating_point<Scalar>) add_contenders<Scalar, padded>(points, count, only_owns);
    measure(std::string("domain/time/") + name_of<Scalar> + "/any/plain_read", count, 3 * sizeof(Scalar), [=] {
        std::uint64_t sum = 0;
        for (const auto& column : points->still.columns) sum += plain_read(std::span<const Scalar>(column));
        benchmark::DoNotOptimize(sum);
    });
}

void run_times(std::size_t count, bool only_owns, row_reporter& report) {
    add_scalar<double>(count, only_owns);
    if (!only_owns) {
        add_scalar<float>(count, false);
        add_scalar<coarse_lattice>(count, false);
        add_scalar<fine_lattice>(count, false);
    }
    run_registered(report);
}

// ---------------------------------------------------------------------------------------------------------------
// Drift: x <- wrap(x + d), a million times, against exact arithmetic in units of 2^-64 box lengths. The box is
// [offset, offset + 1), so that every number in it less the offset is exact in double.

constexpr std::size_t wanderers = 64;
constexpr std::uint64_t wrap_count = 1'000'000;

struct named_offset {
    const char* name;
    double value;
};
constexpr named_offset offsets[] = {{"0", 0}, {"1e3", 1e3}, {"1e6", 1e6}, {"1e9", 1e9}};

/// How finely starts and steps are drawn: as the scalar can hold a step between 1 and 2, or so that double holds every
/// sum at every offset, and float near 0.
template <class Scalar>
constexpr int step_bits(bool fine) {
    if (!fine) return 20;
    if constexpr (tsubu::is_lattice<Scalar>)
        return 8 * static_cast<int>(sizeof(Scalar));
    else
        return std::numeric_limits<Scalar>::digits - 1;
}

struct drift {
    double held = 0;  ///< error of the position as it is held, in box lengths
    double read = 0;  ///< error of the same, read in real units
};

double distance(std::uint64_t a, std::uint64_t b) {
    const std::uint64_t apart = a - b;
    return static_cast<double>(apart >> 63 != 0 ? b - a : apart) * 0x1p-64;  // the shorter way round
}
std::uint64_t fraction_of(double share) { return static_cast<std::uint64_t>(share * 0x1p64); }

/// `step`: 2^-64 box lengths beyond one whole length, forwards or backwards.
template <class Scalar>
drift wander(const tsubu::domain<1, Scalar>& box, double offset, std::uint64_t start, std::uint64_t step,
             bool forwards) {
    const std::uint64_t moved = wrap_count * (forwards ? step : 0 - step);
    if constexpr (tsubu::is_lattice<Scalar>) {
        using Int = decltype(Scalar{}.value);
        const auto steps = (forwards ? step : 0 - step) >> (64 - 8 * sizeof(Int));
        const auto d = static_cast<Int>(static_cast<std::make_unsigned_t<Int>>(steps));
        auto x = position_of<Scalar>(start);
        for (std::uint64_t n = 0; n < wrap_count; ++n) {
            x = box.wrap({x + d}).position[0];
            benchmark::DoNotOptimize(x);  // else the sum of all steps is computed at once
        }
        const auto exact_place = start + moved;
        const auto lowest = position_of<Scalar>(0).value;
        const auto above = static_cast<std::uint64_t>(static_cast<std::make_unsigned_t<Int>>(
            static_cast<std::make_unsigned_t<Int>>(x.value) - static_cast<std::make_unsigned_t<Int>>(lowest)));
        const double read = box.to_real({x})[0] - offset - static_cast<double>(exact_place) * 0x1p-64;
        return {distance(above << (64 - 8 * sizeof(Int)), exact_place), std::abs(std::remainder(read, 1.0))};
    } else {
        const auto d = static_cast<Scalar>((forwards ? 1 : -1) * (1 + static_cast<double>(step) * 0x1p-64));
        auto x = static_cast<Scalar>(offset + static_cast<double>(start) * 0x1p-64);
        if (!box.contains({x})) x = static_cast<Scalar>(offset);
        const auto exact_place = fraction_of(static_cast<double>(x) - offset) + moved;  // from the start as it is held
        for (std::uint64_t n = 0; n < wrap_count; ++n) x = box.wrap({x + d}).position[0];
        const double error = distance(fraction_of(static_cast<double>(x) - offset), exact_place);
        return {error, error};
    }
}

template <class Scalar>
void run_drift(row_reporter& report) {
    for (const bool fine : {false, true})
        for (const auto& offset : offsets) {
            const auto name = std::string("domain/wrap_error/") + name_of<Scalar> + (fine ? "/fine" : "/coarse") +
                              "/offset:" + offset.name;
            try {
                const auto box = cube<1, Scalar>(offset.value, 1, true);
                tsubu::random_stream random(3);
                drift worst;
                const std::uint64_t digits = ~std::uint64_t{0} << (64 - step_bits<Scalar>(fine));
                for (std::size_t k = 0; k < wanderers; ++k) {
                    const auto start = random() & digits;
                    const auto found = wander(box, offset.value, start, random() & digits, k % 2 == 0);
                    worst = {(std::max)(worst.held, found.held), (std::max)(worst.read, found.read)};
                }
                report.counted(name, {{"error", worst.held},
                                      {"error_as_read", worst.read},
                                      {"wraps", static_cast<double>(wrap_count)},
                                      {"particles", static_cast<double>(wanderers)}});
            } catch (const tsubu::input_error& refusal) {
                report.refused(name, refusal.what());
            }
        }
}

// ---------------------------------------------------------------------------------------------------------------
// Partition: over all ranks, one owner for each point of the box and none for any other; one extended owner for all.

constexpr std::size_t random_points = 1000;
constexpr double margin = .1;

struct partition_count {
    double wrong_inside = 0, wrong_outside = 0, wrong_extended = 0, points = 0;
};

template <std::size_t D, class Scalar, class Border>
class partition_counter {
public:
    partition_counter(double scale, std::size_t parts, partition_count& count)
        : scale_(static_cast<Scalar>(scale)), bricks_(cube<D, Scalar, Border>(0, scale, false), parts), count_(&count) {
        for (std::size_t rank = 0; rank < bricks_.ranks(); ++rank) parts_.push_back(bricks_.subdomain(rank));
    }
    void run() {
        ask_special_points();
        ask_random_points();
    }

private:
    using position = tsubu::vec<D, Scalar>;

    /// Faces and cuts, and the numbers next to them.
    [[nodiscard]] std::vector<Scalar> special_coordinates(std::size_t axis) const {
        std::vector<Scalar> faces = {bricks_.whole().along(axis).hi()};
        for (std::size_t part = 0; part < bricks_.along(axis).parts(); ++part)
            faces.push_back(bricks_.along(axis).begin(part));
        std::vector<Scalar> all;
        constexpr auto infinity = std::numeric_limits<Scalar>::infinity();
        for (const auto face : faces)
            for (const auto x : {std::nextafter(face, -infinity), face, std::nextafter(face, infinity)})
                all.push_back(x);
        return all;
    }
    void ask_special_points() {
        if constexpr (D == 1) {
            for (const auto x : special_coordinates(0)) ask({x});
        } else {
            for (const auto x : special_coordinates(0))
                for (const auto y : special_coordinates(1)) ask({x, y});
        }
    }
    void ask_random_points() {
        tsubu::random_stream random(4);
        for (std::size_t i = 0; i < random_points; ++i) {
            position inside{};
            for (auto& x : inside) x = scale_ * static_cast<Scalar>(random.unit());
            ask(inside);
            position outside{};
            for (auto& x : outside) x = scale_ * static_cast<Scalar>((1 + 2 * margin) * random.unit() - margin);
            const auto beyond = scale_ * static_cast<Scalar>(margin * (1 - random.unit()));
            outside[random.below(D)] = random.below(2) == 0 ? -beyond : scale_ + beyond;
            ask(outside);
        }
    }
    void ask(const position& x) {
        std::size_t owners = 0;
        std::size_t extended = 0;
        for (const auto& part : parts_) {
            owners += part.owns(x) ? 1U : 0U;
            extended += part.owns_extended(x) ? 1U : 0U;
        }
        const bool inside = bricks_.whole().contains(x);
        count_->points += 1;
        count_->wrong_inside += inside && owners != 1 ? 1 : 0;
        count_->wrong_outside += !inside && owners != 0 ? 1 : 0;
        count_->wrong_extended += extended != 1 ? 1 : 0;
    }

    Scalar scale_;
    tsubu::brick_decomposition<D, Scalar, Border> bricks_;
    std::vector<tsubu::subdomain<D, Scalar>> parts_;
    partition_count* count_;
};

/// Powers of ten, every one from 1e-12 to 1e12; float ends where its numbers do.
template <class Scalar>
std::vector<std::string> scales() {
    constexpr int last = std::numeric_limits<Scalar>::max_exponent10 < 300 ? 37 : 300;
    std::vector<std::string> all;
    for (int exponent = -last; exponent <= last; ++exponent) {
        const int size = exponent < 0 ? -exponent : exponent;
        if (size > 12 && size % 10 != 0 && size != last) continue;
        char text[16];
        std::snprintf(text, sizeof text, "1e%+03d", exponent);
        all.emplace_back(text);
    }
    return all;
}

template <class Scalar, class Border>
void count_partitions(row_reporter& report) {
    for (const auto& scale : scales<Scalar>()) {
        const auto name =
            std::string("domain/partition/") + name_of<Scalar> + "/" + name_of<Border> + "/scale:" + scale;
        const double size = std::strtod(scale.c_str(), nullptr);
        partition_count count;
        try {
            for (const std::size_t parts : {4U, 7U}) {
                partition_counter<1, Scalar, Border>(size, parts, count).run();
                partition_counter<2, Scalar, Border>(size, parts, count).run();
            }
            report.counted(name, {{"wrong_owned", count.wrong_inside + count.wrong_outside},
                                  {"wrong_inside", count.wrong_inside},
                                  {"wrong_outside", count.wrong_outside},
                                  {"wrong_extended", count.wrong_extended},
                                  {"points", count.points}});
        } catch (const tsubu::input_error& refusal) {
            report.refused(name, refusal.what());
        }
    }
}

template <class Scalar>
void run_partition(row_reporter& report) {
    count_partitions<Scalar, exact>(report);
    count_partitions<Scalar, padded>(report);
}

// ---------------------------------------------------------------------------------------------------------------
// The plan

std::vector<group> plan(extent how_much) {
    std::vector<group> groups;
    for (const std::size_t count : {10'000U, 100'000U, 1'000'000U, 10'000'000U}) {
        if (how_much == extent::quick && count > 1'000'000) continue;
        const bool only_owns = how_much != extent::full && count > 1'000'000;
        const double seconds = how_much == extent::quick ? 1.3 : 5;
        groups.push_back({"domain/time/N:" + std::to_string(count),
                          only_owns ? 2 : seconds + static_cast<double>(count) / 1e6,
                          [=](row_reporter& report) { run_times(count, only_owns, report); }});
    }
    if (how_much != extent::quick) {  // 5e8 wraps take a while
        groups.push_back({"domain/wrap_error/double", 8, run_drift<double>});
        groups.push_back({"domain/wrap_error/float", 6, run_drift<float>});
        groups.push_back({"domain/wrap_error/lattice32", .3, run_drift<coarse_lattice>});
        groups.push_back({"domain/wrap_error/lattice64", .3, run_drift<fine_lattice>});
    }
    groups.push_back({"domain/partition/double", .5, run_partition<double>});
    groups.push_back({"domain/partition/float", .3, run_partition<float>});
    return groups;
}

// ---------------------------------------------------------------------------------------------------------------
// The command line.

constexpr const char* usage =
    "bench_domain [--quick | --full] [--only TEXT] [--benchmark_out=FILE.json] [--benchmark_...]\n"
    "  --quick     N = 1e4, 1e5, 1e6, without wraps: some seconds\n"
    "  (neither)   longer repetitions, and owns on 1e7 points of double: about 2 minutes\n"
    "  --full      everything for 1e7 points as well: 6 GB of memory\n"
    "  --only TEXT only groups whose name contains it, such as domain/time/N:100000\n"
    "TSUBU_INSTRUCTION_SET=portable|avx2|avx512 limits what the batches may use.\n";

int run(const options& chosen) {
    return run_groups("bench_domain", plan(chosen.how_much), chosen);
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
    return bench::run_program(argc, argv, "bench_domain", bench::usage, false, bench::run);
}

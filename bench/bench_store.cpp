// SPDX-License-Identifier: MIT
/// @file
/// What a layout costs: four operations on a store of each layout, beside the same by hand on arrays of that layout; and
/// what growth copies.
///
/// A group is one number of particles: all layouts and their hand-written twins hold them at the same time, and the
/// repetitions of their operations run in random order.

#include "support/aligned_column.hpp"
#include "support/command_line.hpp"
#include "support/progress.hpp"
#include "support/row_reporter.hpp"
#include "support/run_context.hpp"

#include <tsubu/core/random.hpp>
#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/pack.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/soa.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <benchmark/benchmark.h>

#include <array>      // std::array
#include <cstddef>    // std::size_t
#include <cstdint>    // std::int64_t, std::uint64_t
#include <cstdio>     // std::fprintf
#include <cstdlib>    // EXIT_SUCCESS
#include <cstring>    // std::memcpy
#include <memory>     // std::make_shared
#include <numeric>    // std::iota
#include <span>       // std::span
#include <stdexcept>  // std::runtime_error
#include <string>     // std::string
#include <utility>    // std::swap
#include <vector>     // std::vector

namespace bench {
namespace {

using tsubu::index_t;
using tsubu::vec;

constexpr double time_step = 1e-5;
constexpr std::size_t neighbours = 12;  // of a dense packing

/// What each of them carries: 104 bytes.
using carried = tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::velocity<3>, tsubu::force<3>, tsubu::radius,
                              tsubu::mass>;
constexpr std::size_t carried_bytes = 8 + 3 * 24 + 2 * 8;
constexpr std::size_t carried_words = carried_bytes / 8;

/// What is asked of all alike: neighbours near in memory, a third of the particles to pack, an order to permute into.
struct questions {
    std::vector<index_t> near;    // [count * neighbours]
    std::vector<index_t> chosen;  // [count / 3]
    std::vector<index_t> order;   // [count]

    explicit questions(std::size_t count) : near(count * neighbours), chosen(count / 3), order(count) {
        tsubu::random_stream random(4);
        const auto some = [&](std::size_t i) {  // within 500 places: particles that were sorted along a curve
            const auto place = i + random.below(1000);
            return static_cast<index_t>(place < 500 ? 0 : place - 500 < count ? place - 500 : count - 1);
        };
        for (std::size_t n = 0; n < near.size(); ++n) near[n] = some(n / neighbours);
        for (auto& i : chosen) i = static_cast<index_t>(random.below(count));
        std::iota(order.begin(), order.end(), 0);
        for (auto n = count; n > 1; --n) std::swap(order[n - 1], order[static_cast<std::size_t>(random.below(n))]);
    }
};

/// What a particle is filled with; the same in all layouts.
double start_value(std::size_t i, std::size_t k) { return 1 + static_cast<double>((i * 7 + k) % 1000) * 1e-3; }

// ---------------------------------------------------------------------------------------------------------------
// The store

template <class Layout>
class store_contender {
public:
    explicit store_contender(std::size_t count) {
        particles_.add_owned(count);
        for (std::size_t i = 0; i < count; ++i) {
            particles_[tsubu::id][i] = static_cast<std::int64_t>(i);
            for (std::size_t k = 0; k < 3; ++k) {
                particles_[tsubu::position<3>][i][k] = start_value(i, k);
                particles_[tsubu::velocity<3>][i][k] = start_value(i, k + 3);
                particles_[tsubu::force<3>][i][k] = start_value(i, k + 6);
            }
            particles_[tsubu::radius][i] = start_value(i, 9);
            particles_[tsubu::mass][i] = start_value(i, 10);
        }
    }
    void update() {
        const auto x = particles_[tsubu::position<3>];
        const auto v = particles_[tsubu::velocity<3>];
        const auto f = particles_[tsubu::force<3>];
        const auto m = particles_[tsubu::mass];
        const auto count = particles_.size();
        for (std::size_t i = 0; i < count; ++i) {
            const double share = time_step / m[i];
            for (std::size_t k = 0; k < 3; ++k) {
                v[i][k] += f[i][k] * share;
                x[i][k] += v[i][k] * time_step;
            }
        }
    }
    [[nodiscard]] double gather(const questions& asked) const {
        const auto x = particles_[tsubu::position<3>];
        const auto r = particles_[tsubu::radius];
        const auto count = particles_.size();
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t n = 0; n < neighbours; ++n) {
                const auto j = static_cast<std::size_t>(asked.near[i * neighbours + n]);
                double square = 0;
                for (std::size_t k = 0; k < 3; ++k) square += (x[j][k] - x[i][k]) * (x[j][k] - x[i][k]);
                sum += square < (r[i] + r[j]) * (r[i] + r[j]) ? 1 : 0;
            }
        return sum;
    }
    void pack(const questions& asked, std::span<std::uint64_t> out) const {
        tsubu::pack(particles_, carried{}, asked.chosen, out);
    }
    void permute(const questions& asked) { particles_.permute(asked.order); }
    [[nodiscard]] std::size_t memory_bytes() const { return particles_.memory_bytes(); }
    [[nodiscard]] double position_sum() const {
        double sum = 0;
        for (std::size_t i = 0; i < particles_.size(); ++i)
            sum += particles_[tsubu::position<3>][i][2] * static_cast<double>(i % 17);
        return sum;
    }

private:
    tsubu::particle_store<carried, Layout> particles_;
};

// ---------------------------------------------------------------------------------------------------------------
// By hand

struct hand_record {
    std::int64_t id;
    vec<3> x, v, f;
    double r, m;
};
template <std::size_t N>
struct alignas(64) hand_block {
    std::int64_t id[N];
    vec<3> x[N], v[N], f[N];
    double r[N], m[N];
};

struct hand_soa {
    aligned_column<std::int64_t> ids;
    aligned_column<vec<3>> xs, vs, fs;
    aligned_column<double> rs, ms;

    explicit hand_soa(std::size_t count) : ids(count), xs(count), vs(count), fs(count), rs(count), ms(count) {}
    [[nodiscard]] std::size_t size() const { return ids.size(); }
    [[nodiscard]] auto& id(std::size_t i) { return ids[i]; }
    [[nodiscard]] auto& x(std::size_t i) { return xs[i]; }
    [[nodiscard]] auto& v(std::size_t i) { return vs[i]; }
    [[nodiscard]] auto& f(std::size_t i) { return fs[i]; }
    [[nodiscard]] auto& r(std::size_t i) { return rs[i]; }
    [[nodiscard]] auto& m(std::size_t i) { return ms[i]; }
    void permute(const std::vector<index_t>& order) {
        const auto one = [&](auto& column) {
            std::remove_reference_t<decltype(column)> fresh(column.size());
            for (std::size_t i = 0; i < fresh.size(); ++i) fresh[i] = column[static_cast<std::size_t>(order[i])];
            column.swap(fresh);
        };
        one(ids), one(xs), one(vs), one(fs), one(rs), one(ms);
    }
};
struct hand_aos {
    aligned_column<hand_record> records;

    explicit hand_aos(std::size_t count) : records(count) {}
    [[nodiscard]] std::size_t size() const { return records.size(); }
    [[nodiscard]] auto& id(std::size_t i) { return records[i].id; }
    [[nodiscard]] auto& x(std::size_t i) { return records[i].x; }
    [[nodiscard]] auto& v(std::size_t i) { return records[i].v; }
    [[nodiscard]] auto& f(std::size_t i) { return records[i].f; }
    [[nodiscard]] auto& r(std::size_t i) { return records[i].r; }
    [[nodiscard]] auto& m(std::size_t i) { return records[i].m; }
    void permute(const std::vector<index_t>& order) {
        aligned_column<hand_record> fresh(records.size());
        for (std::size_t i = 0; i < fresh.size(); ++i) fresh[i] = records[static_cast<std::size_t>(order[i])];
        records.swap(fresh);
    }
};
template <std::size_t N>
struct hand_aosoa {
    aligned_column<hand_block<N>> blocks;
    std::size_t count;

    explicit hand_aosoa(std::size_t n) : blocks((n + N - 1) / N), count(n) {}
    [[nodiscard]] std::size_t size() const { return count; }
    [[nodiscard]] auto& id(std::size_t i) { return blocks[i / N].id[i % N]; }
    [[nodiscard]] auto& x(std::size_t i) { return blocks[i / N].x[i % N]; }
    [[nodiscard]] auto& v(std::size_t i) { return blocks[i / N].v[i % N]; }
    [[nodiscard]] auto& f(std::size_t i) { return blocks[i / N].f[i % N]; }
    [[nodiscard]] auto& r(std::size_t i) { return blocks[i / N].r[i % N]; }
    [[nodiscard]] auto& m(std::size_t i) { return blocks[i / N].m[i % N]; }
    void permute(const std::vector<index_t>& order) {
        hand_aosoa fresh(count);
        for (std::size_t i = 0; i < count; ++i) {
            const auto from = static_cast<std::size_t>(order[i]);
            fresh.id(i) = id(from);
            fresh.x(i) = x(from);
            fresh.v(i) = v(from);
            fresh.f(i) = f(from);
            fresh.r(i) = r(from);
            fresh.m(i) = m(from);
        }
        blocks.swap(fresh.blocks);
    }
};

template <class Arrays>
class hand_contender {
public:
    explicit hand_contender(std::size_t count) : a_(count) {
        for (std::size_t i = 0; i < count; ++i) {
            a_.id(i) = static_cast<std::int64_t>(i);
            for (std::size_t k = 0; k < 3; ++k) {
                a_.x(i)[k] = start_value(i, k);
                a_.v(i)[k] = start_value(i, k + 3);
                a_.f(i)[k] = start_value(i, k + 6);
            }
            a_.r(i) = start_value(i, 9);
            a_.m(i) = start_value(i, 10);
        }
    }
    void update() {
        const auto count = a_.size();
        for (std::size_t i = 0; i < count; ++i) {
            const double share = time_step / a_.m(i);
            for (std::size_t k = 0; k < 3; ++k) {
                a_.v(i)[k] += a_.f(i)[k] * share;
                a_.x(i)[k] += a_.v(i)[k] * time_step;
            }
        }
    }
    [[nodiscard]] double gather(const questions& asked) {
        const auto count = a_.size();
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t n = 0; n < neighbours; ++n) {
                const auto j = static_cast<std::size_t>(asked.near[i * neighbours + n]);
                double square = 0;
                for (std::size_t k = 0; k < 3; ++k) square += (a_.x(j)[k] - a_.x(i)[k]) * (a_.x(j)[k] - a_.x(i)[k]);
                sum += square < (a_.r(i) + a_.r(j)) * (a_.r(i) + a_.r(j)) ? 1 : 0;
            }
        return sum;
    }
    void pack(const questions& asked, std::span<std::uint64_t> out) {
        auto* to = out.data();
        for (const auto chosen : asked.chosen) {
            const auto i = static_cast<std::size_t>(chosen);
            std::memcpy(to, &a_.id(i), 8);
            std::memcpy(to + 1, &a_.x(i), 24);
            std::memcpy(to + 4, &a_.v(i), 24);
            std::memcpy(to + 7, &a_.f(i), 24);
            std::memcpy(to + 10, &a_.r(i), 8);
            std::memcpy(to + 11, &a_.m(i), 8);
            to += carried_words;
        }
    }
    void permute(const questions& asked) { a_.permute(asked.order); }
    [[nodiscard]] double position_sum() {
        double sum = 0;
        for (std::size_t i = 0; i < a_.size(); ++i) sum += a_.x(i)[2] * static_cast<double>(i % 17);
        return sum;
    }

private:
    Arrays a_;
};

// ---------------------------------------------------------------------------------------------------------------

template <class Pass>
void measure(const std::string& name, std::size_t count, std::size_t items, double bytes_per_particle, Pass pass) {
    benchmark::RegisterBenchmark((name + "/N:" + std::to_string(count)).c_str(), [=](benchmark::State& state) {
        for (auto _ : state) {
            pass();
            benchmark::ClobberMemory();
        }
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(items));
        state.counters["bytes_per_particle"] = bytes_per_particle;
    });
}

template <class Contender>
std::shared_ptr<Contender> add(const std::string& name, std::size_t count, double bytes_per_particle,
                               const std::shared_ptr<questions>& asked) {
    const auto one = std::make_shared<Contender>(count);
    const auto out = std::make_shared<std::vector<std::uint64_t>>(asked->chosen.size() * carried_words);
    measure(name + "/update", count, count, bytes_per_particle, [=] { one->update(); });
    measure(name + "/gather", count, count, bytes_per_particle, [=] { benchmark::DoNotOptimize(one->gather(*asked)); });
    measure(name + "/pack", count, asked->chosen.size(), bytes_per_particle, [=] {
        one->pack(*asked, *out);
        benchmark::DoNotOptimize(out->data());
    });
    measure(name + "/permute", count, count, bytes_per_particle, [=] { one->permute(*asked); });
    return one;
}

/// A layout of the store and its twin by hand. They must agree before they are measured.
template <class Layout, class Arrays>
void add_layout(const std::string& name, std::size_t count, const std::shared_ptr<questions>& asked) {
    store_contender<Layout> store(count);
    hand_contender<Arrays> hand(count);
    std::vector<std::uint64_t> packed(asked->chosen.size() * carried_words);
    auto packed_by_hand = packed;
    for (int pass = 0; pass < 2; ++pass) {
        store.update(), hand.update();
        store.permute(*asked), hand.permute(*asked);
    }
    store.pack(*asked, packed), hand.pack(*asked, packed_by_hand);
    if (store.position_sum() != hand.position_sum() || store.gather(*asked) != hand.gather(*asked) ||
        packed != packed_by_hand)
        throw std::runtime_error(name + ": the store and its hand-written twin differ; figures would be worthless");
    const auto bytes = static_cast<double>(store.memory_bytes()) / static_cast<double>(count);
    add<store_contender<Layout>>("store/" + name + "/tsubu", count, bytes, asked);
    add<hand_contender<Arrays>>("store/" + name + "/by_hand", count, carried_bytes, asked);
}

/// Elements that are copied while `appends` particles come one by one.
template <class Growth>
void report_growth(const char* name, std::uint64_t appends, row_reporter& report) {
    std::uint64_t capacity = 0;
    std::uint64_t copied = 0;
    std::uint64_t reallocations = 0;
    while (capacity < appends) {
        copied += capacity;
        ++reallocations;
        capacity = Growth{}.next(capacity, capacity + 1);
    }
    report.counted("store/growth/" + std::string(name) + "/appends:" + std::to_string(appends),
                   {{"copied", static_cast<double>(copied)}, {"reallocations", static_cast<double>(reallocations)}});
}

constexpr const char* usage =
    "bench_store [--quick | --full] [--only TEXT] [--benchmark_out=FILE.json] [--benchmark_...]\n"
    "  --quick     N = 1e4, 1e6\n"
    "  (neither)   N = 1e4, 1e5, 1e6\n"
    "  --full      N = 1e7 as well: 8 GB of memory\n"
    "  --only TEXT only groups whose name contains it, such as store/N:100000\n";

int run(const options& chosen) {
    std::vector<std::size_t> sizes = {10'000, 1'000'000};
    if (chosen.how_much != extent::quick) sizes = {10'000, 100'000, 1'000'000};
    if (chosen.how_much == extent::full) sizes.push_back(10'000'000);
    std::erase_if(sizes, [&](std::size_t count) {
        return ("store/N:" + std::to_string(count)).find(chosen.only) == std::string::npos;
    });
    auto context = run_context();
    context.emplace_back("extent", extent_names[static_cast<int>(chosen.how_much)]);
    row_reporter report(chosen.out, context);
    double all = 0;
    for (const auto count : sizes) all += static_cast<double>(count) + 1e5;
    progress shown(all);
    for (std::size_t k = 0; k < sizes.size(); ++k) {
        const auto count = sizes[k];
        shown.begin(k + 1, sizes.size(), "store/N:" + std::to_string(count));
        const auto asked = std::make_shared<questions>(count);
        add_layout<tsubu::soa, hand_soa>("soa", count, asked);
        add_layout<tsubu::aos, hand_aos>("aos", count, asked);
        add_layout<tsubu::aosoa<16>, hand_aosoa<16>>("aosoa16", count, asked);
        benchmark::RunSpecifiedBenchmarks(&report);
        benchmark::ClearRegisteredBenchmarks();
        shown.end(static_cast<double>(count) + 1e5);
    }
    for (const std::uint64_t appends : {1'000'000ULL, 10'000'000ULL, 100'000'000ULL}) {
        report_growth<tsubu::geometric_growth>("geometric", appends, report);
        report_growth<tsubu::block_growth>("block", appends, report);
    }
    report.close();
    std::fprintf(stderr, "%s: written after %.0f s\n", chosen.out.c_str(), shown.seconds());
    return EXIT_SUCCESS;
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
    std::vector<char*> arguments(argv, argv + argc);
    for (const std::string_view word : arguments)
        if (word == "--help") {
            std::fputs(bench::usage, stdout);
            return EXIT_SUCCESS;
        }
    bench::options chosen;
    chosen.out = "bench_store.json";
    if (!bench::parse(arguments, chosen)) {
        std::fputs(bench::usage, stderr);
        return 2;
    }
    try {
        bench::initialize_benchmark(arguments, chosen.how_much);
        return bench::run(chosen);
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "bench_store: %s\n", failure.what());
        return EXIT_FAILURE;
    }
}

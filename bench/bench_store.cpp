// SPDX-License-Identifier: MIT
/// @file
/// What a layout costs: operations on a store of each layout, beside the same by hand on arrays of that layout, and as
/// particles carry more; what a sort along a curve saves; what growth copies.
///
/// A store and its hand-written twin are built in random order and take turns, so that whatever slows the machine slows
/// both: a row holds the medians of both over the turns of one repetition, and that of their ratio. Repetitions of
/// different rows run in random order.

#include "support/command_line.hpp"
#include "support/groups.hpp"
#include "support/registered.hpp"
#include "support/timed_turns.hpp"

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/domain/domain.hpp>
#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/curve.hpp>
#include <tsubu/store/pack.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/soa.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>   // std::max, std::none_of, std::nth_element, std::sort
#include <array>       // std::array
#include <cmath>       // std::cbrt, std::ceil
#include <cstddef>     // std::size_t
#include <cstdint>     // std::int64_t, std::uint64_t
#include <cstdio>      // std::fprintf
#include <cstdlib>     // EXIT_SUCCESS, std::free, std::malloc
#include <cstring>     // std::memcpy, std::memset, std::strcmp
#include <ctime>       // clock_gettime
#include <functional>  // std::function
#include <memory>      // std::make_shared
#include <numeric>     // std::iota
#include <span>        // std::span
#include <stdexcept>   // std::runtime_error
#include <string>      // std::string
#include <utility>     // std::swap
#include <vector>      // std::vector

#if defined(__GLIBC__)
#include <malloc.h>  // mallopt
#endif

namespace bench {
namespace {

using tsubu::index_t;
using tsubu::vec;

constexpr double time_step = 1e-5;
constexpr std::size_t neighbours = 12;  // of a dense packing

/// What each particle carries: 96 bytes.
using carried = tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::velocity<3>, tsubu::force<3>, tsubu::radius,
                              tsubu::mass>;
constexpr std::size_t carried_bytes = 8 + 3 * 24 + 2 * 8;
constexpr std::size_t carried_words = carried_bytes / 8;

/// What else particles carry: histories, temperatures, stresses.
template <std::size_t Words>
inline constexpr tsubu::field<"load", std::array<double, Words>> load{};
template <std::size_t Words>
using loaded = tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::velocity<3>, tsubu::force<3>, tsubu::radius,
                             tsubu::mass, load<Words>>;

// ---------------------------------------------------------------------------------------------------------------
// Where the particles are, and what is asked of all alike

using box_type = tsubu::domain<3>;

[[nodiscard]] box_type unit_box() { return {{0, 0, 0}, {1, 1, 1}}; }

[[nodiscard]] std::vector<index_t> shuffled(std::size_t count) {
    std::vector<index_t> order(count);
    std::iota(order.begin(), order.end(), 0);
    tsubu::random_stream random(4);
    for (auto n = count; n > 1; --n) std::swap(order[n - 1], order[static_cast<std::size_t>(random.below(n))]);
    return order;
}

/// Particles on a cubic grid, in some order.
class grid {
public:
    explicit grid(std::size_t count)
        : count_(count), side_(static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(count)) - 1e-9))) {}

    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] vec<3> operator[](std::size_t cell) const {
        const auto step = 1 / static_cast<double>(side_);
        const auto at = coordinates(cell);
        return {step * static_cast<double>(at[0]), step * static_cast<double>(at[1]),
                step * static_cast<double>(at[2])};
    }
    /// The cell beside `cell` in the n-th of twelve directions, those of a dense packing; across the faces of the box.
    [[nodiscard]] std::size_t beside(std::size_t cell, std::size_t n) const {
        auto at = coordinates(cell);
        const auto still = n / 4;  // the axis along which it is not beside
        const auto first = (still + 1) % 3;
        const auto second = (still + 2) % 3;
        at[first] = (at[first] + (n % 2 == 0 ? 1 : side_ - 1)) % side_;
        at[second] = (at[second] + (n / 2 % 2 == 0 ? 1 : side_ - 1)) % side_;
        const auto found = (at[2] * side_ + at[1]) * side_ + at[0];
        return found < count_ ? found : cell;  // the last layer is not full
    }

private:
    [[nodiscard]] std::array<std::size_t, 3> coordinates(std::size_t cell) const {
        return {cell % side_, cell / side_ % side_, cell / (side_ * side_)};
    }

    std::size_t count_;
    std::size_t side_;
};

struct questions {
    std::vector<vec<3>> places;       // [count]
    std::vector<index_t> near;        // [count * neighbours]
    std::vector<index_t> chosen;      // [count / 3], ascending
    std::vector<index_t> permutation; // [count], random

    /// @param cells  which cell of the grid is whose
    explicit questions(const std::vector<index_t>& cells)
        : places(cells.size()), near(cells.size() * neighbours), chosen(cells.size() / 3),
          permutation(shuffled(cells.size())) {
        const grid all(cells.size());
        std::vector<index_t> owner(cells.size());
        for (std::size_t i = 0; i < cells.size(); ++i)
            owner[static_cast<std::size_t>(cells[i])] = static_cast<index_t>(i);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const auto cell = static_cast<std::size_t>(cells[i]);
            places[i] = all[cell];
            for (std::size_t n = 0; n < neighbours; ++n) near[i * neighbours + n] = owner[all.beside(cell, n)];
        }
        tsubu::random_stream random(5);
        for (auto& i : chosen) i = static_cast<index_t>(random.below(cells.size()));
        std::sort(chosen.begin(), chosen.end());
    }
};

template <class Curve>
[[nodiscard]] std::vector<index_t> cells_along(const Curve& curve, std::size_t count) {
    return tsubu::order_along(curve, unit_box(), grid(count));
}

/// What a particle is filled with beside its place; the same in all layouts.
[[nodiscard]] double start_value(std::size_t i, std::size_t k) {
    return 1 + static_cast<double>((i * 7 + k) % 1024) * 0x1p-10;
}

// ---------------------------------------------------------------------------------------------------------------
// The store
//
// An operation is a function of its own, here and by hand, and the build aligns loops to cache lines: where a loop of a
// few instructions happens to lie can double its time, and tells nothing.

template <class Layout, class Fields = carried>
class store_contender {
public:
    explicit store_contender(const questions& asked) {
        particles_.add_owned(asked.places.size());
        for (std::size_t i = 0; i < particles_.size(); ++i) {
            particles_[tsubu::id][i] = static_cast<std::int64_t>(i);
            particles_[tsubu::position<3>][i] = asked.places[i];
            for (std::size_t k = 0; k < 3; ++k) {
                particles_[tsubu::velocity<3>][i][k] = start_value(i, k);
                particles_[tsubu::force<3>][i][k] = start_value(i, k + 3);
            }
            particles_[tsubu::radius][i] = start_value(i, 6);
            particles_[tsubu::mass][i] = start_value(i, 7);
        }
    }
    [[gnu::noinline]] void update() {
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
    [[gnu::noinline]] void swell() {
        const auto r = particles_[tsubu::radius];
        const auto count = particles_.size();
        for (std::size_t i = 0; i < count; ++i) r[i] *= 1 + 0x1p-40;
    }
    [[nodiscard, gnu::noinline]] double gather(const questions& asked) const {
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
    [[gnu::noinline]] void pack(const questions& asked, std::span<std::uint64_t> out) const {
        tsubu::pack(particles_, Fields{}, asked.chosen, out);
    }
    [[gnu::noinline]] void permute(const questions& asked) { particles_.permute(asked.permutation); }
    [[nodiscard]] double memory_bytes() const { return static_cast<double>(particles_.memory_bytes()); }
    [[nodiscard]] double capacity() const { return static_cast<double>(particles_.capacity()); }
    [[nodiscard]] auto places() const { return particles_[tsubu::position<3>]; }

private:
    tsubu::particle_store<Fields, Layout> particles_;
};

// ---------------------------------------------------------------------------------------------------------------
// By hand

/// Memory as the store asks for it, or page faults would be compared: not written before it is used, from a cache line
/// on, in huge pages where it is large.
template <class Value>
class hand_array {
    struct alignas(64) line {
        unsigned char bytes[64];
    };

public:
    explicit hand_array(std::size_t count) : lines_((count * sizeof(Value) + 63) / 64, {}) {}
    [[nodiscard]] Value* data() { return reinterpret_cast<Value*>(lines_.data()); }

private:
    tsubu::buffer<line> lines_;
};

// Each has a view, pointers and no more, through which loops read and write: of the arrays themselves a compiler cannot
// know that they stay where they are.

struct hand_soa {
    struct view {
        std::int64_t* ids;
        vec<3>*xs, *vs, *fs;
        double *rs, *ms;
        [[nodiscard]] auto& id(std::size_t i) const { return ids[i]; }
        [[nodiscard]] auto& x(std::size_t i) const { return xs[i]; }
        [[nodiscard]] auto& v(std::size_t i) const { return vs[i]; }
        [[nodiscard]] auto& f(std::size_t i) const { return fs[i]; }
        [[nodiscard]] auto& r(std::size_t i) const { return rs[i]; }
        [[nodiscard]] auto& m(std::size_t i) const { return ms[i]; }
    };
    hand_array<std::int64_t> ids;
    hand_array<vec<3>> xs, vs, fs;
    hand_array<double> rs, ms;

    explicit hand_soa(std::size_t count) : ids(count), xs(count), vs(count), fs(count), rs(count), ms(count) {}
    [[nodiscard]] view look() { return {ids.data(), xs.data(), vs.data(), fs.data(), rs.data(), ms.data()}; }
    void permute(const std::vector<index_t>& order) {
        hand_soa fresh(order.size());
        const auto one = [&](const auto* from, auto* to) {
            for (std::size_t i = 0; i < order.size(); ++i) to[i] = from[order[i]];
        };
        const auto from = look();
        const auto to = fresh.look();
        one(from.ids, to.ids), one(from.xs, to.xs), one(from.vs, to.vs), one(from.fs, to.fs), one(from.rs, to.rs);
        one(from.ms, to.ms);
        *this = std::move(fresh);
    }
};
struct hand_aos {
    struct record {
        std::int64_t id;
        vec<3> x, v, f;
        double r, m;
    };
    struct view {
        record* records;
        [[nodiscard]] auto& id(std::size_t i) const { return records[i].id; }
        [[nodiscard]] auto& x(std::size_t i) const { return records[i].x; }
        [[nodiscard]] auto& v(std::size_t i) const { return records[i].v; }
        [[nodiscard]] auto& f(std::size_t i) const { return records[i].f; }
        [[nodiscard]] auto& r(std::size_t i) const { return records[i].r; }
        [[nodiscard]] auto& m(std::size_t i) const { return records[i].m; }
    };
    hand_array<record> records;

    explicit hand_aos(std::size_t count) : records(count) {}
    [[nodiscard]] view look() { return {records.data()}; }
    void permute(const std::vector<index_t>& order) {
        hand_aos fresh(order.size());
        const auto* from = records.data();
        auto* to = fresh.records.data();
        for (std::size_t i = 0; i < order.size(); ++i) to[i] = from[order[i]];
        *this = std::move(fresh);
    }
};
template <std::size_t N>
struct hand_aosoa {
    struct alignas(64) block {
        std::int64_t id[N];
        vec<3> x[N], v[N], f[N];
        double r[N], m[N];
    };
    struct view {
        block* blocks;
        [[nodiscard]] auto& id(std::size_t i) const { return blocks[i / N].id[i % N]; }
        [[nodiscard]] auto& x(std::size_t i) const { return blocks[i / N].x[i % N]; }
        [[nodiscard]] auto& v(std::size_t i) const { return blocks[i / N].v[i % N]; }
        [[nodiscard]] auto& f(std::size_t i) const { return blocks[i / N].f[i % N]; }
        [[nodiscard]] auto& r(std::size_t i) const { return blocks[i / N].r[i % N]; }
        [[nodiscard]] auto& m(std::size_t i) const { return blocks[i / N].m[i % N]; }
    };
    hand_array<block> blocks;

    explicit hand_aosoa(std::size_t count) : blocks((count + N - 1) / N) {}
    [[nodiscard]] view look() { return {blocks.data()}; }
    void permute(const std::vector<index_t>& order) {
        hand_aosoa fresh(order.size());
        const auto from = look();
        const auto to = fresh.look();
        for (std::size_t i = 0; i < order.size(); ++i) {
            const auto j = static_cast<std::size_t>(order[i]);
            to.id(i) = from.id(j);
            to.x(i) = from.x(j);
            to.v(i) = from.v(j);
            to.f(i) = from.f(j);
            to.r(i) = from.r(j);
            to.m(i) = from.m(j);
        }
        *this = std::move(fresh);
    }
};

template <class Arrays>
class hand_contender {
public:
    explicit hand_contender(const questions& asked) : arrays_(asked.places.size()), count_(asked.places.size()) {
        const auto a = arrays_.look();
        for (std::size_t i = 0; i < count_; ++i) {
            a.id(i) = static_cast<std::int64_t>(i);
            a.x(i) = asked.places[i];
            for (std::size_t k = 0; k < 3; ++k) {
                a.v(i)[k] = start_value(i, k);
                a.f(i)[k] = start_value(i, k + 3);
            }
            a.r(i) = start_value(i, 6);
            a.m(i) = start_value(i, 7);
        }
    }
    [[gnu::noinline]] void update() {
        const auto a = arrays_.look();
        const auto count = count_;
        for (std::size_t i = 0; i < count; ++i) {
            const double share = time_step / a.m(i);
            for (std::size_t k = 0; k < 3; ++k) {
                a.v(i)[k] += a.f(i)[k] * share;
                a.x(i)[k] += a.v(i)[k] * time_step;
            }
        }
    }
    [[gnu::noinline]] void swell() {
        const auto a = arrays_.look();
        const auto count = count_;
        for (std::size_t i = 0; i < count; ++i) a.r(i) *= 1 + 0x1p-40;
    }
    [[nodiscard, gnu::noinline]] double gather(const questions& asked) {
        const auto a = arrays_.look();
        const auto count = count_;
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t n = 0; n < neighbours; ++n) {
                const auto j = static_cast<std::size_t>(asked.near[i * neighbours + n]);
                double square = 0;
                for (std::size_t k = 0; k < 3; ++k) square += (a.x(j)[k] - a.x(i)[k]) * (a.x(j)[k] - a.x(i)[k]);
                sum += square < (a.r(i) + a.r(j)) * (a.r(i) + a.r(j)) ? 1 : 0;
            }
        return sum;
    }
    [[gnu::noinline]] void pack(const questions& asked, std::span<std::uint64_t> out) {
        const auto a = arrays_.look();
        auto* to = out.data();
        for (const auto chosen : asked.chosen) {
            const auto i = static_cast<std::size_t>(chosen);
            std::memcpy(to, &a.id(i), 8);
            std::memcpy(to + 1, &a.x(i), 24);
            std::memcpy(to + 4, &a.v(i), 24);
            std::memcpy(to + 7, &a.f(i), 24);
            std::memcpy(to + 10, &a.r(i), 8);
            std::memcpy(to + 11, &a.m(i), 8);
            to += carried_words;
        }
    }
    [[gnu::noinline]] void permute(const questions& asked) { arrays_.permute(asked.permutation); }

private:
    Arrays arrays_;
    std::size_t count_;
};

// ---------------------------------------------------------------------------------------------------------------
// Pairs that take turns

/// Of this thread, so that what else runs on the machine does not count. [ns]
[[nodiscard]] double time_used() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e9 + static_cast<double>(now.tv_nsec);
}
[[nodiscard]] double median(std::vector<double> all) {
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
}
template <class Pass>
[[nodiscard]] double time_of(std::size_t rounds, const Pass& pass) {
    const auto before = time_used();
    for (std::size_t round = 0; round < rounds; ++round) {
        pass();
        benchmark::ClobberMemory();
    }
    return (time_used() - before) / static_cast<double>(rounds);
}

constexpr double turn_length = 3e5;  // [ns] at least: a thousand times what asking for the time takes

/// How many turns each of a pair takes in a repetition.
[[nodiscard]] std::size_t turns_for(std::size_t count) { return count > 3'000'000 ? 3 : count > 300'000 ? 7 : 11; }

/// @param operation  called with either of the two
template <class Store, class Hand, class Operation>
void measure_pair(const std::string& name, const std::shared_ptr<questions>& asked, std::size_t items,
                  Operation operation) {
    const auto random = std::make_shared<tsubu::random_stream>(6);
    benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
        std::unique_ptr<Store> store;
        std::unique_ptr<Hand> hand;
        if (random->below(2) == 0) store = std::make_unique<Store>(*asked);
        hand = std::make_unique<Hand>(*asked);
        if (!store) store = std::make_unique<Store>(*asked);
        const auto run_store = [&] { operation(*store); };
        const auto run_hand = [&] { operation(*hand); };
        static_cast<void>(time_of(1, run_hand));  // both have touched their memory before they are timed
        const auto rounds = static_cast<std::size_t>(std::max(1.0, turn_length / time_of(1, run_store)));
        std::vector<double> by_store;
        std::vector<double> by_hand;
        for (auto _ : state) {
            double sum = 0;
            for (std::size_t turn = 0; turn < turns_for(asked->places.size()); ++turn) {
                const bool store_first = random->below(2) == 0;
                if (store_first) by_store.push_back(time_of(rounds, run_store));
                by_hand.push_back(time_of(rounds, run_hand));
                if (!store_first) by_store.push_back(time_of(rounds, run_store));
                sum += (by_store.back() + by_hand.back()) * static_cast<double>(rounds);
            }
            state.SetIterationTime(sum * 1e-9);
        }
        state.counters["store_ns"] = median(by_store) / static_cast<double>(items);
        std::vector<double> ratios;
        for (std::size_t turn = 0; turn < by_hand.size(); ++turn) ratios.push_back(by_store[turn] / by_hand[turn]);
        state.counters["ratio"] = median(ratios);
        state.counters["by_hand_ns"] = median(by_hand) / static_cast<double>(items);
        state.counters["bytes_per_place"] = store->memory_bytes() / store->capacity();
        state.counters["bytes_per_particle"] = store->memory_bytes() / static_cast<double>(asked->places.size());
    })->UseManualTime();
}

/// They must agree before they are measured.
template <class Store, class Hand>
void compare(const std::string& name, const questions& asked, std::vector<std::uint64_t>& packed) {
    Store store(asked);
    Hand hand(asked);
    std::vector<std::uint64_t> packed_by_hand(packed.size());
    for (int pass = 0; pass < 2; ++pass) {
        store.update(), hand.update();
        store.swell(), hand.swell();
        store.permute(asked), hand.permute(asked);
    }
    store.pack(asked, packed), hand.pack(asked, packed_by_hand);
    if (store.gather(asked) != hand.gather(asked) || packed != packed_by_hand)
        throw std::runtime_error(name + ": the store and its hand-written twin differ; figures would be worthless");
}

template <class Layout, class Arrays>
void add_layout(const std::string& layout, const std::shared_ptr<questions>& asked,
                const std::shared_ptr<std::vector<std::uint64_t>>& out) {
    using store = store_contender<Layout>;
    using hand = hand_contender<Arrays>;
    const auto count = asked->places.size();
    compare<store, hand>(layout, *asked, *out);
    const auto name = [&](const char* operation) {
        return "store/pair/" + layout + "/" + operation + "/N:" + std::to_string(count);
    };
    measure_pair<store, hand>(name("update"), asked, count, [](auto& one) { one.update(); });
    measure_pair<store, hand>(name("one_field"), asked, count, [](auto& one) { one.swell(); });
    measure_pair<store, hand>(name("gather"), asked, count,
                              [=](auto& one) { benchmark::DoNotOptimize(one.gather(*asked)); });
    measure_pair<store, hand>(name("pack"), asked, asked->chosen.size(), [=](auto& one) {
        one.pack(*asked, *out);
        benchmark::DoNotOptimize(out->data());
    });
    measure_pair<store, hand>(name("permute"), asked, count, [=](auto& one) { one.permute(*asked); });
}

void run_pairs(std::size_t count, row_reporter& report) {
    const auto asked = std::make_shared<questions>(cells_along(tsubu::hilbert_curve{}, count));
    const auto out = std::make_shared<std::vector<std::uint64_t>>(asked->chosen.size() * carried_words);
    add_layout<tsubu::soa, hand_soa>("soa", asked, out);
    add_layout<tsubu::aos, hand_aos>("aos", asked, out);
    add_layout<tsubu::aosoa<16>, hand_aosoa<16>>("aosoa16", asked, out);
    run_registered(report);
}

// ---------------------------------------------------------------------------------------------------------------
// Field sets: the same operations as particles carry more

/// All layouts with one set of fields, in turns. They must agree before they are measured.
template <class Fields>
class field_set {
    static constexpr std::size_t bytes = tsubu::particle_store<Fields>::bytes_per_particle;

public:
    field_set(const questions& asked, std::size_t rounds) : asked_(&asked), out_(asked.chosen.size() * bytes / 8) {
        add<tsubu::soa>("soa");
        add<tsubu::aos>("aos");
        add<tsubu::aosoa<16>>("aosoa16");
        rounds_ = rounds;
    }
    void measure(row_reporter& report) const { take_turns(report, all_, rounds_); }

private:
    template <class Layout>
    void add(const char* layout) {
        const auto one = std::make_shared<store_contender<Layout, Fields>>(*asked_);
        one->update();
        one->permute(*asked_);
        one->pack(*asked_, out_);
        if (first_packed_.empty()) first_packed_ = out_;
        if (out_ != first_packed_)
            throw std::runtime_error(std::string("store/carried: ") + layout + " packs other bytes than soa");

        const auto count = asked_->places.size();
        const auto add_operation = [&](const char* operation, std::size_t items, auto pass) {
            const std::string name = std::string("store/carried/") + layout + "/" + operation + "/" +
                                     std::to_string(bytes) + "/N:" + std::to_string(count);
            const auto passes = static_cast<std::size_t>(std::max(1.0, turn_length / time_of(1, pass)));
            all_.push_back({name, static_cast<double>(items),
                            [=](row_fields&) { return 1e-9 * time_of(passes, pass); }});
        };
        add_operation("update", count, [one] { one->update(); });
        add_operation("permute", count, [this, one] { one->permute(*asked_); });
        add_operation("pack", asked_->chosen.size(), [this, one] {
            one->pack(*asked_, out_);
            benchmark::DoNotOptimize(out_.data());
        });
    }

    const questions* asked_;
    std::vector<std::uint64_t> out_, first_packed_;
    std::vector<timed_contender> all_;
    std::size_t rounds_ = 0;
};

void run_field_sets(std::size_t count, std::size_t rounds, row_reporter& report) {
    const questions asked(cells_along(tsubu::hilbert_curve{}, count));
    field_set<carried>(asked, rounds).measure(report);  // 96 bytes
    field_set<loaded<8>>(asked, rounds).measure(report);
    field_set<loaded<24>>(asked, rounds).measure(report);
    field_set<loaded<56>>(asked, rounds).measure(report);
}

// ---------------------------------------------------------------------------------------------------------------
// Sorting: what the order costs, and what the gather costs in it

template <class Pass>
void measure(const std::string& name, std::size_t count, Pass pass) {
    benchmark::RegisterBenchmark((name + "/N:" + std::to_string(count)).c_str(), [=](benchmark::State& state) {
        for (auto _ : state) {
            pass();
            benchmark::ClobberMemory();
        }
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
    });
}

/// `asked`: of particles in random order, and sorted along each curve.
template <class Layout>
void measure_gathers(const std::string& layout, const std::array<std::shared_ptr<questions>, 3>& asked,
                     row_reporter& report) {
    constexpr std::array<const char*, 3> orders = {"random", "morton", "hilbert"};
    for (std::size_t k = 0; k < orders.size(); ++k) {
        const auto one = std::make_shared<store_contender<Layout>>(*asked[k]);
        measure("store/sorted/" + layout + "/" + orders[k], asked[k]->places.size(),
                [one, order = asked[k]] { benchmark::DoNotOptimize(one->gather(*order)); });
    }
    run_registered(report);
}

void run_sorting(std::size_t count, row_reporter& report) {
    const std::array<std::shared_ptr<questions>, 3> asked = {
        std::make_shared<questions>(shuffled(count)),
        std::make_shared<questions>(cells_along(tsubu::morton_curve{}, count)),
        std::make_shared<questions>(cells_along(tsubu::hilbert_curve{}, count))};
    measure_gathers<tsubu::soa>("soa", asked, report);
    measure_gathers<tsubu::aos>("aos", asked, report);
    measure_gathers<tsubu::aosoa<16>>("aosoa16", asked, report);
    const auto unsorted = std::make_shared<store_contender<tsubu::soa>>(*asked[0]);
    const auto add_order = [&](const char* name, const auto& curve) {
        measure(std::string("store/order/") + name, count, [=] {
            const auto order = tsubu::order_along(curve, unit_box(), unsorted->places());
            benchmark::DoNotOptimize(order.data());
        });
    };
    add_order("morton", tsubu::morton_curve{});
    add_order("hilbert", tsubu::hilbert_curve{});
    run_registered(report);
}

// ---------------------------------------------------------------------------------------------------------------
// Growth

/// Elements that are copied while `appends` particles come one by one: by count, for more than anyone waits for.
template <class Growth>
void count_growth(const std::string& name, std::uint64_t appends, row_reporter& report) {
    std::uint64_t capacity = 0;
    std::uint64_t copied = 0;
    std::uint64_t reallocations = 0;
    while (capacity < appends) {
        copied += capacity;
        ++reallocations;
        capacity = Growth{}.next(capacity, capacity + 1);
    }
    report.counted("store/growth/" + name + "/appends:" + std::to_string(appends),
                   {{"copied", static_cast<double>(copied)}, {"reallocations", static_cast<double>(reallocations)}});
}

/// Appends that are really made.
template <class Append>
void time_appends(const std::string& name, std::uint64_t appends, int repetitions, row_reporter& report,
                  Append append) {
    for (int k = 0; k < repetitions; ++k) {
        const auto nanoseconds = time_of(1, [&] { append(appends); });
        report.counted("store/append/" + name + "/appends:" + std::to_string(appends),
                       {{"ns_per_append", nanoseconds / static_cast<double>(appends)}});
    }
}
template <class Growth>
void append_to_store(std::uint64_t appends) {
    tsubu::particle_store<carried, tsubu::soa, Growth> particles;
    for (std::uint64_t i = 0; i < appends; ++i)
        particles.push_back(tsubu::id = static_cast<std::int64_t>(i), tsubu::radius = 0.5);
    benchmark::DoNotOptimize(particles[tsubu::radius].data());
}
void append_to_vector(std::uint64_t appends) {
    std::vector<hand_aos::record> particles;
    for (std::uint64_t i = 0; i < appends; ++i)
        particles.push_back({static_cast<std::int64_t>(i), {}, {}, {}, 0.5, 0});
    benchmark::DoNotOptimize(particles.data());
}

void run_growth(extent how_much, row_reporter& report) {
    for (const std::uint64_t appends : {10'000U, 100'000U, 1'000'000U, 10'000'000U, 100'000'000U}) {
        count_growth<tsubu::geometric_growth>("geometric", appends, report);
        count_growth<tsubu::block_growth>("block", appends, report);
    }
    for (const std::uint64_t appends : {10'000U, 100'000U, 1'000'000U, 10'000'000U}) {
        const bool is_long = appends > 1'000'000;
        if (is_long && how_much == extent::quick) continue;
        const int repetitions = is_long ? 3 : 5;
        time_appends("geometric", appends, repetitions, report, append_to_store<tsubu::geometric_growth>);
        time_appends("std_vector", appends, repetitions, report, append_to_vector);
        if (!is_long || how_much == extent::full)  // 3e11 bytes are copied for 1e7 particles
            time_appends("block", appends, is_long ? 1 : repetitions, report, append_to_store<tsubu::block_growth>);
    }
}

// ---------------------------------------------------------------------------------------------------------------
// The plan

std::vector<group> plan(extent how_much) {
    std::vector<group> groups;
    for (const std::size_t count : {10'000U, 100'000U, 1'000'000U, 10'000'000U}) {
        if (count > 100'000 && how_much == extent::quick) continue;
        if (count == 10'000'000 && how_much != extent::full) continue;
        const auto end = "/N:" + std::to_string(count);
        const auto long_ones = static_cast<double>(count) / 1e6;
        groups.push_back({"store/pair" + end, (how_much == extent::quick ? 30 : 60) * (0.02 + long_ones),
                          [=](row_reporter& r) { run_pairs(count, r); }});
        groups.push_back({"store/sorting" + end, 0.5 + 9 * long_ones, [=](row_reporter& r) { run_sorting(count, r); }});
    }
    // All layouts of the largest particles, 544 bytes each, are in memory at once: no more than this fit into 2 GB.
    for (const std::size_t count : {10'000U, 300'000U})
        groups.push_back({"store/carried/N:" + std::to_string(count), 1 + 1e-5 * static_cast<double>(count),
                          [=](row_reporter& report) {
                              run_field_sets(count, how_much == extent::quick ? 5 : 11, report);
                          }});
    groups.push_back({"store/growth", how_much == extent::full ? 150.0 : how_much == extent::quick ? 1.5 : 12.0,
                      [=](row_reporter& report) { run_growth(how_much, report); }});
    return groups;
}

constexpr const char* usage =
    "bench_store [--quick | --full] [--only TEXT] [--benchmark_out=FILE.json] [--benchmark_...]\n"
    "  --quick     N = 1e4, 1e5: a quarter of a minute, 2 GB of memory\n"
    "  (neither)   N = 1e4, 1e5, 1e6, and more repetitions: about 4 minutes\n"
    "  --full      N = 1e7 as well: 12 GB of memory\n"
    "  --only TEXT only groups whose name contains it, such as store/pair/N:100000 or store/growth\n";

/// All memory lies in huge pages that were written before, and stays with the program when it is freed. Else what a
/// store and its twin happen to get decides: which lines of a cache their pages share, and which of them pays for fresh
/// pages.
void keep_memory([[maybe_unused]] std::size_t bytes) {
#if defined(__GLIBC__)
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, -1);
    if (void* all = std::malloc(bytes)) {
        tsubu::advise_huge_pages(all, bytes);
        std::memset(all, 1, bytes);
        benchmark::DoNotOptimize(all);
        std::free(all);
    }
#endif
}

int run(const options& chosen) {
    keep_memory((chosen.how_much == extent::full ? std::size_t{11'000} : std::size_t{2'000}) << 20);
    return run_groups("bench_store", plan(chosen.how_much), chosen);
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
    // More repetitions than elsewhere, since differences of a twentieth are looked for. The user's own flags win: they
    // come later.
    std::vector<char*> words(argv, argv + argc);
    char repetitions[] = "--benchmark_repetitions=11";
    const auto is_quick = [](const char* word) { return std::strcmp(word, "--quick") == 0; };
    if (std::none_of(words.begin(), words.end(), is_quick)) words.insert(words.begin() + 1, repetitions);
    return bench::run_program(static_cast<int>(words.size()), words.data(), "bench_store", bench::usage, false,
                              bench::run);
}

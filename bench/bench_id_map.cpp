// SPDX-License-Identifier: MIT
/// @file
/// Every map x every pattern of ids x every size x every operation, interleaved, into one JSON file.
///
/// A group is one set of ids: all maps hold it at the same time, and the repetitions of all their operations run in
/// random order, so that whatever disturbs the machine disturbs everyone alike.

#include "patterns/lammps_ids.hpp"
#include "patterns/patterns.hpp"
#include "rivals/std_unordered_map.hpp"
#include "support/command_line.hpp"
#include "support/contender.hpp"
#include "support/groups.hpp"
#include "support/registered.hpp"
#if defined(TSUBU_RIVAL_BOOST)
#include "rivals/boost_flat_map.hpp"
#endif
#if defined(TSUBU_RIVAL_ABSL)
#include "rivals/absl_flat_hash_map.hpp"
#endif

#include <tsubu/id/adaptive_storage.hpp>
#include <tsubu/id/bitmap_storage.hpp>
#include <tsubu/id/chained_storage.hpp>
#include <tsubu/id/dense_storage.hpp>
#include <tsubu/id/flat_storage.hpp>
#include <tsubu/id/paged_storage.hpp>

#include <algorithm>    // std::minmax_element
#include <chrono>       // std::chrono::steady_clock
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int64_t, std::uint32_t, std::uint64_t
#include <cstring>      // std::strcmp
#include <memory>       // std::unique_ptr
#include <stdexcept>    // std::runtime_error
#include <string>       // std::string
#include <utility>      // std::move
#include <vector>       // std::vector

namespace bench {
namespace {

// ---------------------------------------------------------------------------------------------------------------
// The registration lists: who is measured, and at what. Add a policy of your own as a line of `series_list`.

struct series {
    const char* name;
    std::unique_ptr<contender> (*make)(const workload&);
    tsubu::instruction_set most = tsubu::instruction_set::avx512;
    bool (*fits)(const workload&) = nullptr;  ///< measured only where this says so
    bool batches_only = false;                ///< in all other operations it is the series before it
};

template <class Storage>
std::unique_ptr<contender> map_of(const workload& work) {
    return std::make_unique<map_contender<Storage>>(work);
}
template <class Table, class Place>
std::unique_ptr<contender> table_of(const workload& work) {
    return std::make_unique<table_contender<Table, Place>>(work);
}
bool ids_fill_their_range(const workload& work) { return work.fills_range; }
bool vectors_are_used(const workload&) { return tsubu::best_instruction_set() > tsubu::instruction_set::portable; }

using tsubu::instruction_set;

constexpr series series_list[] = {
    {"dense", map_of<tsubu::dense_storage<id_t>>},
    {"bitmap", map_of<tsubu::bitmap_storage<id_t>>},
    {"paged", map_of<tsubu::paged_storage<id_t>>},
    {"flat", map_of<tsubu::flat_storage<id_t>>},
    {"flat_portable", map_of<tsubu::flat_storage<id_t>>, instruction_set::portable, vectors_are_used},
    {"chained_mixed", map_of<tsubu::chained_storage<tsubu::mixed, id_t>>},
    {"chained_mod_prime", map_of<tsubu::chained_storage<tsubu::mod_prime, id_t>>},
    {"adaptive", map_of<tsubu::adaptive_storage<id_t>>},
    {"adaptive_portable", map_of<tsubu::adaptive_storage<id_t>>, instruction_set::portable, vectors_are_used},
    {"std_unordered_map", map_of<std_unordered_map<id_t>>},
#if defined(TSUBU_RIVAL_BOOST)
    {"boost_flat_map", map_of<boost_flat_map<id_t>>},
#endif
#if defined(TSUBU_RIVAL_ABSL)
    {"absl_flat_hash_map", map_of<absl_flat_hash_map<id_t>>},
    {"absl_prefetched", map_of<absl_prefetched<id_t>>, instruction_set::avx512, nullptr, true},
#endif
    {"oracle", table_of<oracle, std::uint32_t>},
    {"plain_array", table_of<plain_array, id_t>, instruction_set::avx512, ids_fill_their_range},
};

using pass = void (*)(contender&, const workload&, std::vector<tsubu::index_t>& answers);

template <question_stream workload::*Stream>
void find_batch(contender& map, const workload& work, std::vector<tsubu::index_t>& answers) {
    answers.resize((work.*Stream).ids.size());
    map.find_batch(work.*Stream, answers);
    benchmark::DoNotOptimize(answers.data());
    benchmark::ClobberMemory();
}
void find_single(contender& map, const workload& work, std::vector<tsubu::index_t>&) {
    benchmark::DoNotOptimize(map.find_single(work.hit));
}
void find_dependent(contender& map, const workload& work, std::vector<tsubu::index_t>&) {
    benchmark::DoNotOptimize(map.find_dependent(work.hit));
}
void rebuild(contender& map, const workload&, std::vector<tsubu::index_t>&) {
    map.rebuild();
    benchmark::ClobberMemory();
}
void rebuild_without_links(contender& map, const workload&, std::vector<tsubu::index_t>&) {
    map.rebuild_without_links();
    benchmark::ClobberMemory();
}
void update(contender& map, const workload&, std::vector<tsubu::index_t>&) {
    map.update();
    benchmark::ClobberMemory();
}

struct operation {
    const char* name;
    pass run;
    bool per_particle;  ///< the time is divided by the particles; else by the questions
    bool in_patterns;   ///< measured for every pattern, not for the sweep of T/N alone
    bool is_quick;      ///< part of the quick run
    bool batch = false;
};

constexpr operation operations[] = {
    {"rebuild", rebuild, true, true, true},
    {"rebuild_without_links", rebuild_without_links, true, false, false},
    {"update", update, true, false, false},
    {"find_single", find_single, false, true, true},
    {"find_dependent", find_dependent, false, false, false},
    {"find_hit", find_batch<&workload::hit>, false, true, true, true},
    {"find_half", find_batch<&workload::half>, false, true, false, true},
    {"find_near", find_batch<&workload::near>, false, false, false, true},
};

// ---------------------------------------------------------------------------------------------------------------
// The plan: which groups.

constexpr std::size_t sizes[] = {10'000, 100'000, 1'000'000, 10'000'000};
constexpr std::uint64_t ratios[] = {1, 2, 8, 64, 1024, 1'000'000};

struct id_group {
    const pattern* made_by;  ///< null: the ids of a file
    std::size_t owned;
    std::uint64_t ratio;
    bool sweep;  ///< all operations
    bool quick = false;

    [[nodiscard]] std::string name() const {
        return std::string(made_by != nullptr ? made_by->name : "file") + "/N:" + std::to_string(owned) +
               "/ratio:" + std::to_string(ratio);
    }
    /// Roughly, as measured.
    [[nodiscard]] double seconds() const {
        const double millions = static_cast<double>(owned) * 1e-6;
        if (quick) return 1.7 + 8 * millions;
        return sweep ? 18 + 25 * millions : 9.5 + 5 * millions;
    }
};

/// Where dense and flat meet lies between 8 and 64 in small sizes, and before 8 in large ones.
bool is_in_quick_sweep(std::size_t owned, std::uint64_t ratio) {
    return ratio == 1 || ratio == 8 || ratio == 1024 || (ratio == 64 && owned <= 100'000);
}

std::vector<id_group> plan(extent how_much) {
    std::vector<id_group> groups;
    const bool quick = how_much == extent::quick;
    const bool full = how_much == extent::full;
    for (const auto owned : sizes)
        for (const auto ratio : ratios)
            if ((full || owned <= 1'000'000) && (!quick || is_in_quick_sweep(owned, ratio)))
                groups.push_back({&patterns[0], owned, ratio, true, quick});
    for (const auto& p : patterns) {
        const bool tested_sparse = p.make == block || p.make == strided || p.make == clustered;
        for (const auto owned : sizes) {
            if (quick && (!p.quick || owned != 100'000)) continue;
            if (!full && !p.quick && owned == 1'000'000) continue;
            if (owned == 10'000 && p.make != bucket_multiples && p.make != stride_of<32771>) continue;
            if (owned == 10'000'000 && (!full || !tested_sparse)) continue;
            if (p.make != uniform) groups.push_back({&p, owned, 8, false, quick});
            if (tested_sparse && !quick && owned < 10'000'000) groups.push_back({&p, owned, 1024, false});
            if (tested_sparse && full && owned < 10'000'000) groups.push_back({&p, owned, 1'000'000, false});
        }
    }
    return groups;
}

// ---------------------------------------------------------------------------------------------------------------
// One group.

struct measured_series {
    const series* which;
    std::unique_ptr<contender> map;
};

/// How many nodes a look-up visits in LIGGGHTS' scheme, on average over the particles.
double mod_prime_visits(const std::vector<id_t>& ids) {
    const auto buckets = tsubu::next_prime(tsubu::chained_capacity(ids.size()));
    std::vector<std::uint32_t> length(buckets, 0);
    double visits = 0;
    for (const auto id : ids) visits += ++length[static_cast<std::uint64_t>(id) % buckets];
    return visits / static_cast<double>(ids.size());
}

/// A series whose passes would take minutes gets a line that says so, and one timed rebuild if that takes seconds.
bool note_if_degenerate(const series& candidate, const workload& work, const std::string& name, row_reporter& report) {
    constexpr double too_many_visits = 200;    // a look-up of microseconds
    constexpr double seconds_of_visits = 2e9;  // at about a nanosecond for each
    if (std::strcmp(candidate.name, "chained_mod_prime") != 0) return false;
    const double visits = mod_prime_visits(work.ids);
    if (visits < too_many_visits) return false;
    const auto particles = static_cast<double>(work.ids.size());
    double nanoseconds = -1;
    if (visits * particles < seconds_of_visits) {
        const auto begin = std::chrono::steady_clock::now();
        const auto map = candidate.make(work);
        nanoseconds = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
        nanoseconds /= particles;
    }
    report.degenerate(name + "/rebuild", visits, nanoseconds);
    report.degenerate(name + "/find_hit", visits, -1);
    return true;
}

std::vector<measured_series> make_all(const workload& work, const std::string& group_name, row_reporter& report) {
    std::vector<measured_series> made;
    for (const auto& candidate : series_list) {
        if (candidate.fits != nullptr && !candidate.fits(work)) continue;
        const auto name = group_name + "/" + candidate.name;
        if (note_if_degenerate(candidate, work, name, report)) continue;
        try {
            const with_instruction_set limited(candidate.most);
            made.push_back({&candidate, candidate.make(work)});
        } catch (const tsubu::limit_error& refusal) {
            report.refused(name, refusal.what());
        }
    }
    return made;
}

/// All maps must give the same answers before any is measured. @throws std::runtime_error that names the one.
void compare_answers(const std::vector<measured_series>& all, const workload& work, const std::string& group_name) {
    std::vector<tsubu::index_t> expected, found;
    for (const auto stream : {&workload::hit, &workload::half, &workload::near}) {
        expected.clear();
        for (const auto& [which, map] : all) {
            if (stream == &workload::half && !map->knows_misses()) continue;
            const with_instruction_set limited(which->most);
            found.assign((work.*stream).ids.size(), 0);
            map->find_batch(work.*stream, found);
            if (expected.empty()) expected = found;
            if (found != expected)
                throw std::runtime_error(group_name + ": " + which->name + " answers otherwise than " +
                                         all.front().which->name + "; its figures would be worthless");
        }
    }
}

void run_operation(benchmark::State& state, const measured_series& subject, const operation& op, const workload& work) {
    const with_instruction_set limited(subject.which->most);
    static std::vector<tsubu::index_t> answers;
    // One pass warms the caches where they are large enough to stay warm.
    if (work.ids.size() <= 200'000) {
        op.run(*subject.map, work, answers);
        if (op.run == update) op.run(*subject.map, work, answers);
    }
    for (auto _ : state) op.run(*subject.map, work, answers);
    if (op.run == update && state.iterations() % 2 != 0) op.run(*subject.map, work, answers);
    const auto items = op.per_particle ? work.ids.size() : work.hit.ids.size();
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(items));
    state.counters["bytes_per_particle"] =
        static_cast<double>(subject.map->memory_bytes()) / static_cast<double>(work.ids.size());
}

bool applies(const operation& op, const measured_series& subject, const id_group& to) {
    if ((!to.sweep && !op.in_patterns) || (to.quick && !op.is_quick)) return false;
    if (subject.which->batches_only && !op.batch) return false;
    if (op.run == find_batch<&workload::half> && subject.which->make == table_of<plain_array, id_t>) return false;
    return op.run != update || subject.map->can_update();
}

void run_group(const id_group& which, const id_set& set, row_reporter& report) {
    const auto work = make_workload(set, which.owned, 1);
    const auto name = which.name();
    const auto all = make_all(work, name, report);
    compare_answers(all, work, name);
    for (const auto& subject : all)
        for (const auto& op : operations)
            if (applies(op, subject, which))
                benchmark::RegisterBenchmark((name + "/" + subject.which->name + "/" + op.name).c_str(),
                                             [&](benchmark::State& state) { run_operation(state, subject, op, work); });
    run_registered(report);
}

// ---------------------------------------------------------------------------------------------------------------
// The command line.

constexpr const char* usage =
    "bench_id_map [--quick | --full] [--ids FILE] [--only TEXT] [--benchmark_out=FILE.json] [--benchmark_...]\n"
    "  --quick     N = 1e4, 1e5, 1e6; T/N = 1, 8, 64, 1024; the main patterns at 1e5; three operations: a minute\n"
    "  (neither)   all T/N, all patterns at 1e5, the main ones at 1e6: about 15 minutes\n"
    "  --full      N = 1e7 as well: more than an hour, 12 GB of memory\n"
    "  --ids FILE  also the ids of a LAMMPS data or dump file\n"
    "  --only TEXT only groups whose name contains it, such as uniform/N:100000/ratio:8\n"
    "TSUBU_INSTRUCTION_SET=portable|avx2|avx512 limits what the maps may use.\n";

int run(const options& chosen) {
    std::vector<id_group> planned;
    std::vector<group> groups;
    id_set from_file;
    run_conditions particular;
    if (!chosen.ids_file.empty()) {
        id_group of_file{nullptr, 0, 0, true};
        from_file = from_lammps(chosen.ids_file, of_file.owned);
        const auto [lowest, highest] = std::minmax_element(from_file.ids.begin(), from_file.ids.end());
        const auto count = from_file.ids.size();
        of_file.ratio = (static_cast<std::uint64_t>(*highest - *lowest) + count / 2) / count;
        planned.push_back(of_file);
        particular.emplace_back("ids_file", chosen.ids_file);
    }
    for (const auto& one : plan(chosen.how_much)) planned.push_back(one);
    for (const auto& one : planned)
        groups.push_back({one.name(), one.seconds(), [one, &from_file](row_reporter& report) {
                              const bool is_made = one.made_by != nullptr;
                              run_group(one, is_made ? one.made_by->make(one.owned, one.ratio, 1) : from_file, report);
                          }});
    return run_groups("bench_id_map", std::move(groups), chosen, particular);
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
    return bench::run_program(argc, argv, "bench_id_map", bench::usage, true, bench::run);
}

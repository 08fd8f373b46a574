// SPDX-License-Identifier: MIT
/// @file
/// One map, or the oracle, that is put through the operations of the suite.
#pragma once

#include "../rivals/perfect_table.hpp"
#include "workload.hpp"

#include <tsubu/core/instruction_set.hpp>
#include <tsubu/id/id_map.hpp>
#include <tsubu/id/memory_limit.hpp>

#include <benchmark/benchmark.h>
#include <unistd.h>  // sysconf

#include <algorithm>  // std::min
#include <concepts>   // std::constructible_from, std::same_as
#include <cstddef>    // std::size_t
#include <cstdint>    // std::int64_t, std::uint64_t
#include <span>       // std::span
#include <vector>     // std::vector

namespace bench {

/// The operations; every call is one pass over the workload, so that a virtual call costs nothing per particle.
/// Look-ups return the sum of their answers.
class contender {
public:
    contender() = default;
    contender(const contender&) = delete;
    contender& operator=(const contender&) = delete;
    virtual ~contender() = default;

    virtual void rebuild() = 0;
    virtual void rebuild_without_links() = 0;
    /// From the ids before to those after, or back; the content is again that of rebuild() after an even number.
    virtual void update() = 0;
    [[nodiscard]] virtual bool can_update() const = 0;
    [[nodiscard]] virtual std::int64_t find_single(const question_stream& questions) const = 0;
    /// Each question waits for the answer before it.
    [[nodiscard]] virtual std::int64_t find_dependent(const question_stream& questions) const = 0;
    virtual void find_batch(const question_stream& questions, std::span<tsubu::index_t> out) const = 0;
    [[nodiscard]] virtual std::size_t memory_bytes() const = 0;
    /// The oracle knows the places of the ids that are there, and no others.
    [[nodiscard]] virtual bool knows_misses() const = 0;
};

/// A zero that the compiler does not know: added to a question, it makes it wait for an answer.
[[nodiscard]] inline std::int64_t opaque_zero() noexcept {
    std::int64_t zero = 0;
    benchmark::DoNotOptimize(zero);
    return zero;
}

/// No table may take more than an eighth of the memory of the machine, whatever the library would allow.
[[nodiscard]] inline tsubu::memory_limit memory_limit_here(std::size_t particles) {
    const auto physical =
        static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
    return tsubu::memory_limit((std::min)(tsubu::memory_limit{}.bytes(particles), physical / 8));
}

template <tsubu::id_storage Storage>
class map_contender final : public contender {
public:
    /// @throws tsubu::limit_error if the policy refuses these ids.
    explicit map_contender(const workload& work) : work_(&work), map_(make_storage(work.ids.size())) { rebuild(); }

    void rebuild() override { map_.rebuild(work_->ids, same_); }
    void rebuild_without_links() override { map_.rebuild(work_->ids); }
    void update() override {
        if (changed_)
            map_.update(work_->after, work_->ids, same_);
        else
            map_.update(work_->ids, work_->after, same_);
        changed_ = !changed_;
    }
    [[nodiscard]] bool can_update() const override { return true; }
    [[nodiscard]] std::int64_t find_single(const question_stream& questions) const override {
        std::int64_t sum = 0;
        for (const auto id : questions.ids) sum += map_.find(id);
        return sum;
    }
    [[nodiscard]] std::int64_t find_dependent(const question_stream& questions) const override {
        const auto zero = opaque_zero();
        std::int64_t sum = 0;
        std::int64_t answer = 0;
        for (const auto id : questions.ids) {
            answer = map_.find(id + (answer & zero));
            sum += answer;
        }
        return sum;
    }
    void find_batch(const question_stream& questions, std::span<tsubu::index_t> out) const override {
        map_.find(questions.ids, out);
    }
    [[nodiscard]] std::size_t memory_bytes() const override { return map_.memory_bytes(); }
    [[nodiscard]] bool knows_misses() const override { return true; }

private:
    static Storage make_storage(std::size_t particles) {
        if constexpr (std::constructible_from<Storage, tsubu::memory_limit>)
            return Storage(memory_limit_here(particles));
        else
            return Storage();
    }

    const workload* work_;
    tsubu::id_map<Storage> map_;
    tsubu::same_id_links same_;
    bool changed_ = false;
};

/// The oracle or the plain array: they are told the places.
template <class Table, class Place>
class table_contender final : public contender {
public:
    explicit table_contender(const workload& work)
        : work_(&work), table_(work.different, origin_of(work)), links_(work.ids.size()) {
        rebuild();
    }

    void rebuild() override { table_.rebuild(places_of(*work_), links_); }
    void rebuild_without_links() override { table_.rebuild(places_of(*work_), {}); }
    void update() override {}
    [[nodiscard]] bool can_update() const override { return false; }
    [[nodiscard]] std::int64_t find_single(const question_stream& questions) const override {
        std::int64_t sum = 0;
        for (const auto place : places_of(questions)) sum += table_.at(place);
        return sum;
    }
    [[nodiscard]] std::int64_t find_dependent(const question_stream& questions) const override {
        const auto zero = static_cast<Place>(opaque_zero());
        std::int64_t sum = 0;
        tsubu::index_t answer = 0;
        for (const auto place : places_of(questions)) {
            answer = table_.at(place + (static_cast<Place>(answer) & zero));
            sum += answer;
        }
        return sum;
    }
    void find_batch(const question_stream& questions, std::span<tsubu::index_t> out) const override {
        table_.at(places_of(questions), out);
    }
    [[nodiscard]] std::size_t memory_bytes() const override { return table_.memory_bytes(); }
    [[nodiscard]] bool knows_misses() const override { return false; }

private:
    static constexpr bool place_is_id = std::same_as<Place, id_t>;

    [[nodiscard]] static Place origin_of(const workload& work) {
        if constexpr (place_is_id)
            return work.lowest;
        else
            return 0;
    }
    // Of the workload itself or of one of its streams.
    template <class Stream>
    [[nodiscard]] static std::span<const Place> places_of(const Stream& stream) {
        if constexpr (place_is_id)
            return stream.ids;
        else
            return stream.places;
    }

    const workload* work_;
    Table table_;
    std::vector<tsubu::index_t> links_;
};

/// Runs what it is constructed around with at most the given instruction set, and restores the old one.
class with_instruction_set {
public:
    explicit with_instruction_set(tsubu::instruction_set most) : before_(tsubu::best_instruction_set()) {
        if (most < before_) tsubu::use_instruction_set(most);
    }
    with_instruction_set(const with_instruction_set&) = delete;
    with_instruction_set& operator=(const with_instruction_set&) = delete;
    ~with_instruction_set() { tsubu::use_instruction_set(before_); }

private:
    tsubu::instruction_set before_;
};

}  // namespace bench

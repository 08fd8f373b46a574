// SPDX-License-Identifier: MIT
/// @file
/// Does a layout keep the seven laws of particle_layout? A suite for any test framework, or none.
///
///     tsubu::testing::check_layout<my_layout>(7, 1000, [](bool ok, std::string_view law) { ... });
///
/// Beside the layout goes a std::vector of structs, to which the same is done; after each step all rows are compared.
#pragma once

#include <tsubu/core/random.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/store/concepts.hpp>

#include <algorithm>    // std::max, std::min, std::sort
#include <array>        // std::array
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int64_t, std::uint16_t, std::uint64_t, std::uintptr_t
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <tuple>        // std::tuple
#include <utility>      // std::index_sequence, std::move, std::pair, std::swap
#include <vector>       // std::vector

namespace tsubu::testing {

/// The laws of particle_layout as the suite reports them: a name for each text; never an object.
struct layout_law {
    layout_law() = delete;

    static constexpr const char* apart = "law 1: at<K>(i) is aligned, and no two values overlap";
    static constexpr const char* place = "law 2: place<K>() finds what at<K> finds, from any row on";
    static constexpr const char* copy_row = "law 3: copy_row copies each value, and changes no other row";
    static constexpr const char* swap_rows = "law 3: swap_rows swaps each value, and changes no other row";
    static constexpr const char* gather = "law 4: after gather, row i is what row order[i] was";
    static constexpr const char* capacity = "law 5: reallocate makes room for what it is asked for";
    static constexpr const char* kept = "law 5: reallocate keeps the rows that it is asked to keep";
    static constexpr const char* bytes =
        "law 6: memory_bytes() is at most the sum of the values, 1 % and 128 bytes per value type more";
    static constexpr const char* copied = "law 7: a copy is independent of its source";
};

}  // namespace tsubu::testing

namespace tsubu::detail {

/// A layout and its model, and what may happen to both.
template <particle_layout Layout, class Check, class... Values>
class layout_examiner {
    using memory = typename Layout::template memory<Values...>;
    using row = std::tuple<Values...>;
    static constexpr auto all = std::index_sequence_for<Values...>{};

public:
    layout_examiner(std::uint64_t seed, Check& check) : seed_(seed), random_(seed), check_(check) {}

    void step() {
        const auto dice = random_.below(16);
        if (rows_.empty() || dice == 0) return reallocate();
        if (dice == 1) return gather();
        if (dice == 2) return copy();
        if (dice < 6) {
            write(random_.below(rows_.size()));
            return report(holds(memory_, rows_), testing::layout_law::apart);
        }
        const auto i = random_.below(rows_.size());
        const auto j = random_.below(rows_.size());
        if (dice < 11) {
            memory_.copy_row(i, j);
            rows_[j] = rows_[i];
            report(holds(memory_, rows_), testing::layout_law::copy_row);
        } else {
            memory_.swap_rows(i, j);
            std::swap(rows_[i], rows_[j]);
            report(holds(memory_, rows_), testing::layout_law::swap_rows);
        }
    }
    /// Laws 1, 2 and 6, of `count` rows.
    void examine_places(std::size_t count) {
        memory some;
        some.reallocate(count, 0);
        std::vector<std::pair<std::uintptr_t, std::size_t>> taken;
        bool is_aligned = true;
        bool is_found = true;
        each([&]<std::size_t K>() {
            using value = std::tuple_element_t<K, row>;
            const auto& read = some;
            for (std::size_t i = 0; i < some.capacity(); ++i) {
                const auto* const at = &some.template at<K>(i);
                const auto address = reinterpret_cast<std::uintptr_t>(at);
                taken.emplace_back(address, sizeof(value));
                is_aligned = is_aligned && address % alignof(value) == 0;
                const auto first = i / 2;
                is_found = is_found && &read.template at<K>(i) == at && &some.template place<K>().at(i) == at &&
                           &read.template place<K>().at(i) == at &&
                           &some.template place<K>().from(first).at(i - first) == at &&
                           &read.template place<K>().from(first / 2).from(first - first / 2).at(i - first) == at;
            }
        });
        std::sort(taken.begin(), taken.end());
        bool is_apart = true;
        for (std::size_t k = 1; k < taken.size(); ++k)
            is_apart = is_apart && taken[k].first - taken[k - 1].first >= taken[k - 1].second;
        report(is_aligned && is_apart, testing::layout_law::apart);
        report(is_found, testing::layout_law::place);
        constexpr std::size_t strictest = (std::max)({alignof(Values)...});
        constexpr std::size_t whole_row = ((sizeof(Values) + ...) + strictest - 1) / strictest * strictest;
        // An array each may begin and end at a cache line.
        const auto most = some.capacity() * whole_row + some.capacity() * whole_row / 100 + sizeof...(Values) * 128;
        report(some.memory_bytes() <= most, testing::layout_law::bytes);
        report(some.capacity() >= count, testing::layout_law::capacity);
    }

private:
    void reallocate() {
        constexpr std::size_t most = 100;  // more rows than a block of any layout that is used
        const auto count = random_.below(most);
        const auto kept = random_.below((std::min)(count, rows_.size()) + 1);
        memory_.reallocate(count, kept);
        rows_.resize(kept);
        report(memory_.capacity() >= count, testing::layout_law::capacity);
        report(holds(memory_, rows_), testing::layout_law::kept);
        if (memory_.capacity() < count) return;
        rows_.resize(count);
        for (std::size_t i = kept; i < count; ++i) write(i);
        report(holds(memory_, rows_), testing::layout_law::apart);
    }
    void write(std::size_t i) {
        const auto word = random_();
        fill(rows_[i], word, all);
        each([&]<std::size_t K>() { memory_.template at<K>(i) = std::get<K>(rows_[i]); });
    }
    void gather() {
        std::vector<index_t> order(random_.below(rows_.size() + 1));
        for (auto& from : order) from = static_cast<index_t>(random_.below(rows_.size()));
        const auto before = rows_;
        for (std::size_t i = 0; i < order.size(); ++i) rows_[i] = before[static_cast<std::size_t>(order[i])];
        memory_.gather(order.data(), order.size());
        rows_.resize(order.size());  // of the others nothing is said
        report(holds(memory_, rows_), testing::layout_law::gather);
    }
    void copy() {
        auto other = memory_;
        const auto before = rows_;
        write(random_.below(rows_.size()));
        report(holds(other, before), testing::layout_law::copied);
        memory_ = std::move(other);
        rows_ = before;
        report(holds(memory_, rows_), testing::layout_law::copied);
    }
    [[nodiscard]] static bool holds(const memory& held, const std::vector<row>& rows) {
        bool equal = held.capacity() >= rows.size();
        each([&]<std::size_t K>() {
            for (std::size_t i = 0; equal && i < rows.size(); ++i)
                equal = held.template at<K>(i) == std::get<K>(rows[i]);
        });
        return equal;
    }
    template <std::size_t... K>
    static void fill(row& values, std::uint64_t word, std::index_sequence<K...>) {
        (set(std::get<K>(values), splitmix64(word + K)), ...);
    }
    template <class Number>
    static void set(Number& value, std::uint64_t word) {
        value = static_cast<Number>(word % 251);
    }
    template <class Number, std::size_t N>
    static void set(std::array<Number, N>& value, std::uint64_t word) {
        for (std::size_t k = 0; k < N; ++k) value[k] = static_cast<Number>(splitmix64(word + k) % 65'521);
    }
    template <class Body>
    static void each(Body&& body) {
        [&]<std::size_t... K>(std::index_sequence<K...>) {
            (body.template operator()<K>(), ...);
        }(all);
    }
    void report(bool kept, const char* text) {
        if (kept) return check_(true, std::string_view(text));
        check_(false, std::string_view(std::string(text) + "; " + std::to_string(rows_.size()) + " rows of " +
                                       std::to_string(sizeof...(Values)) + " values, seed " + std::to_string(seed_)));
    }

    std::uint64_t seed_;
    random_stream random_;
    Check& check_;
    memory memory_;
    std::vector<row> rows_;
};

template <class Layout, class... Values, class Check>
void check_layout_of(std::uint64_t seed, std::size_t steps, Check& check) {
    layout_examiner<Layout, Check, Values...> examiner(seed, check);
    for (const std::size_t count : {0U, 1U, 2U, 5U, 16U, 63U, 64U, 65U, 1000U, 16384U}) examiner.examine_places(count);
    for (std::size_t k = 0; k < steps; ++k) examiner.step();
}

}  // namespace tsubu::detail

namespace tsubu::testing {

/// Does this layout keep the seven laws? Asked of one value, of values of one alignment, and of many.
///
/// @param seed   same seed, same run, on every machine
/// @param steps  random operations for each of the three
/// @param check  called as check(bool kept, std::string_view law); a broken law with the seed behind its text
/// Complexity: up to 100 rows are compared per step.
template <particle_layout Layout, class Check>
void check_layout(std::uint64_t seed, std::size_t steps, Check&& check) {
    detail::check_layout_of<Layout, double>(seed, steps, check);
    detail::check_layout_of<Layout, std::int64_t, std::array<double, 3>, double>(seed, steps, check);
    detail::check_layout_of<Layout, unsigned char, double, std::array<float, 3>, std::uint16_t,
                            std::array<unsigned char, 5>, std::int64_t>(seed, steps, check);
}

}  // namespace tsubu::testing

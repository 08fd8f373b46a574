// SPDX-License-Identifier: MIT
#include <tsubu/store/pack.hpp>

#include <tsubu/core/random.hpp>
#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/standard_fields.hpp>

#include "support/catch.hpp"
#include "unit/last_words.hpp"
#include "unit/thrown.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#if defined(__SSE2__)
#include <xmmintrin.h>  // _mm_getcsr, _mm_setcsr
#endif

namespace {

using index_list = std::vector<tsubu::index_t>;
using words_t = std::vector<std::uint64_t>;

constexpr tsubu::field<"flag", unsigned char> flag{};
constexpr tsubu::field<"triple", std::array<unsigned char, 3>> triple{};
constexpr tsubu::field<"neighbors", tsubu::list_of<std::array<unsigned char, 3>>> neighbors{};
constexpr tsubu::field<"charge", tsubu::bonus_of<double>> charge{};
constexpr tsubu::field<"weight", float> weight{};
using set = tsubu::fields<tsubu::id, tsubu::position<3>, flag, triple, neighbors, charge, weight>;

/// Ids, and doubles, whose bits a conversion would change (C4): past 2^53, infinite, NaN that signals or not, -0.0,
/// denormal.
constexpr std::array<std::uint64_t, 16> hard_bits{0,
                                                  1,
                                                  (1U << 31) - 1,
                                                  1U << 31,
                                                  std::uint64_t{1} << 53,
                                                  (std::uint64_t{1} << 53) + 1,
                                                  0x7FF0000000000000,
                                                  0x7FF0000000000001,
                                                  0x7FF8000000000000,
                                                  0x7FFFFFFFFFFFFFFF,
                                                  0xFFFFFFFFFFFFFFFF,
                                                  0x8000000000000000,
                                                  0x000FFFFFFFFFFFFF,
                                                  0x8000000000000001,
                                                  0xFFF0000000000001,
                                                  0x0010000000000000};

/// Denormal numbers are 0 as long as it lives, both where they are read and where they would come out.
struct flush_to_zero {
#if defined(__SSE2__)
    flush_to_zero() { _mm_setcsr(before | 0x8040U); }
    ~flush_to_zero() { _mm_setcsr(before); }
    flush_to_zero(const flush_to_zero&) = delete;
    flush_to_zero& operator=(const flush_to_zero&) = delete;
    unsigned before = _mm_getcsr();
#else
    flush_to_zero() {}
#endif
};

index_list numbers(std::size_t count, tsubu::index_t stride = 1) {
    index_list result(count);
    for (std::size_t k = 0; k < count; ++k) result[k] = static_cast<tsubu::index_t>(k) * stride;
    return result;
}

template <class Store>
Store filled(std::size_t count) {
    Store g;
    tsubu::random_stream random(3);
    for (std::size_t i = 0; i < count; ++i) {
        g.push_back(tsubu::id = static_cast<std::int64_t>(random()), flag = static_cast<unsigned char>(i),
                    tsubu::position<3> = {random.unit(), random.unit(), random.unit()}, weight = 0.5F,
                    triple = {1, 2, static_cast<unsigned char>(i)});
        for (std::size_t k = 0; k < i % 5; ++k)
            g[neighbors][i].push_back({static_cast<unsigned char>(i), static_cast<unsigned char>(k), 9});
        if (i % 3 == 1) g[charge][i].emplace(static_cast<double>(i));
    }
    return g;
}

/// Packs `first` as one layout, unpacks as another, and packs that: how many words differ.
template <class Store, class Other, class Set>
std::size_t changed(const Store& g, Set which, const index_list& chosen) {
    words_t words(tsubu::packed_words(g, which, chosen), 0xABABABABABABABAB);
    if (tsubu::pack(g, which, chosen, words) != words.size()) return 1'000'000;
    Other h;
    h.add_owned(chosen.size());
    if (tsubu::unpack(h, which, 0, chosen.size(), words) != words.size()) return 2'000'000;
    const auto all = numbers(chosen.size());
    words_t again(tsubu::packed_words(h, which, all), 0xCDCDCDCDCDCDCDCD);
    if (again.size() != words.size()) return 3'000'000;
    tsubu::pack(h, which, all, again);
    std::size_t sum = 0;
    for (std::size_t k = 0; k < words.size(); ++k) sum += words[k] == again[k] ? 0U : 1U;
    return sum;
}

template <class Layout>
std::size_t hard_bits_lost() {
    using bare = tsubu::fields<tsubu::id, tsubu::velocity<3>>;
    tsubu::particle_store<bare, Layout> g;
    g.add_owned(hard_bits.size());
    for (std::size_t k = 0; k < hard_bits.size(); ++k) {
        std::memcpy(&g[tsubu::id][k], &hard_bits[k], 8);
        for (std::size_t n = 0; n < 3; ++n)
            std::memcpy(&g[tsubu::velocity<3>][k][n], &hard_bits[(k + n) % hard_bits.size()], 8);
    }
    g.permute([] {  // bits survive this too
        auto order = numbers(hard_bits.size());
        std::reverse(order.begin(), order.end());
        return order;
    }());
    g.permute([] {
        auto order = numbers(hard_bits.size());
        std::reverse(order.begin(), order.end());
        return order;
    }());
    const auto all = numbers(hard_bits.size());
    words_t words(tsubu::packed_words(g, bare{}, all));
    tsubu::pack(g, bare{}, all, words);
    tsubu::particle_store<bare, Layout> h;
    h.add_ghosts(all.size());
    tsubu::unpack(h, bare{}, 0, all.size(), words);
    std::size_t lost = words.size() == 4 * all.size() ? 0 : 1000;
    for (std::size_t k = 0; k < hard_bits.size(); ++k)
        for (std::size_t n = 0; n < 4; ++n) {
            const auto expected = hard_bits[n == 0 ? k : (k + n - 1) % hard_bits.size()];
            std::uint64_t arrived = 0;
            std::memcpy(&arrived,
                        n == 0 ? static_cast<const void*>(&h[tsubu::id][k]) : &h[tsubu::velocity<3>][k][n - 1], 8);
            lost += words[4 * k + n] == expected && arrived == expected ? 0U : 1U;
        }
    return lost;
}

}  // namespace

TEMPLATE_TEST_CASE("bits arrive as they left, whatever they mean", "[store][C4]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<5>) {
    CHECK(hard_bits_lost<TestType>() == 0);
    const flush_to_zero now;
    CHECK(hard_bits_lost<TestType>() == 0);
}

TEMPLATE_TEST_CASE("any fields of any particles survive the way into another layout", "[store][C4]", tsubu::soa,
                   tsubu::aos, tsubu::aosoa<1>, tsubu::aosoa<16>) {
    using store = tsubu::particle_store<set, TestType>;
    using other = tsubu::particle_store<set, tsubu::aosoa<5>>;
    const auto g = filled<store>(1000);
    CHECK(changed<store, other>(g, set{}, numbers(1000)) == 0);
    CHECK(changed<store, other>(g, set{}, numbers(333, 3)) == 0);
    CHECK(changed<store, other>(g, set{}, index_list{7, 7, 3, 999, 0}) == 0);
    CHECK(changed<store, other>(g, set{}, index_list{}) == 0);
    CHECK(changed<store, other>(g, tsubu::fields<neighbors>{}, numbers(1000)) == 0);
    CHECK(changed<store, other>(g, tsubu::fields<charge, tsubu::id>{}, numbers(1000)) == 0);
    CHECK(changed<store, other>(g, tsubu::fields<triple, flag, weight>{}, numbers(1000)) == 0);
    CHECK(changed<store, other>(g, tsubu::fields_every_step<set>{}, numbers(1000)) == 0);
    CHECK(changed<store, other>(g, tsubu::fields<>{}, numbers(1000)) == 0);
}

TEST_CASE("words are laid out as the header says: fixed sizes first, each value begins one, the rest is 0",
          "[store][C4]") {
    tsubu::particle_store<set, tsubu::aos> g;
    g.push_back(tsubu::id = -2, tsubu::position<3> = {1, 2, 3}, flag = 4, triple = {5, 6, 7}, weight = 1.0F);
    for (unsigned char k = 0; k < 3; ++k) g[neighbors][0].push_back({k, k, k});
    g[charge][0].emplace(-0.0);
    words_t words(20, 0xABABABABABABABAB);
    REQUIRE(tsubu::pack(g, set{}, index_list{0}, words) == 12);
    const auto number = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    const words_t fixed{0xFFFFFFFFFFFFFFFE, number(1), number(2), number(3), 4, 0x070605, 0x3F800000};
    const words_t varying{3, 0x0202010101000000, 0x02, 1, number(-0.0)};
    auto expected = fixed;
    expected.insert(expected.end(), varying.begin(), varying.end());
    if (std::endian::native == std::endian::little) CHECK(words_t(words.begin(), words.begin() + 12) == expected);
    CHECK(words[12] == 0xABABABABABABABAB);
    CHECK(tsubu::packed_words(g, tsubu::fields<triple, neighbors>{}, index_list{0, 0}) == 2 * (1 + 1 + 2));
}

TEST_CASE("fields of a fixed size are packed in the order of the set that is given", "[store]") {
    tsubu::particle_store<set> g;
    g.push_back(tsubu::id = 5, flag = 6);
    words_t words(2);
    tsubu::pack(g, tsubu::fields<flag, tsubu::id>{}, index_list{0}, words);
    CHECK(words == words_t{6, 5});
    tsubu::unpack(g, tsubu::fields<tsubu::id, flag>{}, 0, 1, words);
    CHECK(g[tsubu::id][0] == 6);
    CHECK(g[flag][0] == 5);
}

TEST_CASE("unpacking replaces lists and values that were there, and nothing else", "[store]") {
    using store = tsubu::particle_store<set>;
    const auto g = filled<store>(20);
    using some = tsubu::fields<neighbors, charge>;
    words_t words(tsubu::packed_words(g, some{}, numbers(20)));
    tsubu::pack(g, some{}, numbers(20), words);
    auto h = filled<store>(40);
    const auto before = h[tsubu::id][25];
    REQUIRE(tsubu::unpack(h, some{}, 11, 20, words) == words.size());
    for (std::size_t i = 0; i < 20; ++i) {
        CHECK(h[neighbors][11 + i].size() == i % 5);
        CHECK(h[charge][11 + i].has_value() == (i % 3 == 1));
        if (i % 3 == 1) CHECK(*h[charge][11 + i] == static_cast<double>(i));
    }
    CHECK(h[tsubu::id][25] == before);
    CHECK(h[neighbors][10].size() == 0);
    CHECK(h[neighbors][34].size() == 4);
    CHECK(h[charge].values().size() == h[charge].owners().size());
}

TEST_CASE("a buffer that is too small is left as it is", "[store]") {
    const auto g = filled<tsubu::particle_store<set>>(10);
    const auto needed = tsubu::packed_words(g, set{}, numbers(10));
    words_t words(needed - 1, 7);
    const auto text = thrown<tsubu::input_error>([&] { tsubu::pack(g, set{}, numbers(10), words); });
    CHECK(says(text, "tsubu::pack: " + std::to_string(needed - 1) + " words for " + std::to_string(needed) +
                         "; ask packed_words()"));
    CHECK(words == words_t(needed - 1, 7));
}

TEST_CASE("words that end too early are refused, wherever they end", "[store]") {
    using store = tsubu::particle_store<set>;
    const auto g = filled<store>(7);
    words_t words(tsubu::packed_words(g, set{}, numbers(7)));
    tsubu::pack(g, set{}, numbers(7), words);
    for (std::size_t left = 0; left < words.size(); ++left) {
        const words_t fewer(words.begin(),
                            words.begin() + static_cast<std::ptrdiff_t>(left));  // so that sanitizers see
        store h;
        h.add_owned(7);
        CAPTURE(left);
        CHECK_THROWS_AS(tsubu::unpack(h, set{}, 0, 7, fewer), tsubu::input_error);
    }
    store h;
    h.add_owned(7);
    const auto text = thrown<tsubu::input_error>(
        [&] { tsubu::unpack(h, set{}, 0, 7, std::span<const std::uint64_t>(words).first(words.size() - 1)); });
    CHECK(says(text, "words end in particle 6 of 7; unpack the fields that were packed"));
}

TEST_CASE("a list that claims more elements than there are words takes no memory", "[store]") {
    tsubu::particle_store<tsubu::fields<neighbors>> h;
    h.add_owned(1);
    const auto before = h.memory_bytes();
    for (const std::uint64_t claimed : {std::uint64_t{6}, std::uint64_t{1} << 32, std::uint64_t{1} << 61,
                                        (std::numeric_limits<std::uint64_t>::max)(),
                                        (std::numeric_limits<std::uint64_t>::max)() / 3 + 1}) {
        CAPTURE(claimed);
        CHECK_THROWS_AS(tsubu::unpack(h, tsubu::fields<neighbors>{}, 0, 1, words_t{claimed, 1, 2}), tsubu::input_error);
        CHECK(h[neighbors][0].empty());
        CHECK(h.memory_bytes() == before);
    }
    CHECK(tsubu::unpack(h, tsubu::fields<neighbors>{}, 0, 1, words_t{5, 1, 2}) == 3);
    CHECK(h[neighbors][0].size() == 5);
}

#if defined(__unix__) && !defined(NDEBUG)
TEST_CASE("particles that do not exist are told in debug builds", "[store]") {
    auto g = filled<tsubu::particle_store<set>>(2);
    words_t words(100);
    CHECK(says(last_words([&] { tsubu::pack(g, tsubu::fields<flag>{}, index_list{2}, words); }),
               "no particle with this index"));
    CHECK(says(last_words([&] { tsubu::unpack(g, tsubu::fields<flag>{}, 1, 2, words); }),
               "these particles do not exist; add_owned or add_ghosts first"));
}
#endif

// SPDX-License-Identifier: MIT
#include <tsubu/id/prime.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <cstdint>
#include <limits>
#include <vector>

using tsubu::is_prime;
using tsubu::next_prime;

static_assert(next_prime(1000) == 1009, "next_prime is a constant expression");

TEST_CASE("next_prime is the smallest prime above n", "[id][A7][A8][H2]") {
    struct row {
        std::int64_t n, prime;
    };
    const auto [n, prime] =
        GENERATE(row{0, 2}, row{1, 2}, row{2, 3}, row{3, 5}, row{4, 5}, row{7, 11}, row{8, 11}, row{24, 29},
                 row{48, 53}, row{1000, 1009}, row{2000, 2003}, row{10'000, 10'007}, row{20'000, 20'011},
                 row{32'768, 32'771}, row{65'536, 65'537}, row{1'000'000, 1'000'003}, row{2'147'483'628, 2'147'483'629},
                 row{2'147'483'629, 2'147'483'647}, row{2'147'483'646, 2'147'483'647},
                 row{2'147'483'647, 2'147'483'659});
    INFO("n = " << n);
    CHECK(next_prime(n) == prime);
    CHECK(next_prime(static_cast<std::uint64_t>(n)) == static_cast<std::uint64_t>(prime));
    if (prime <= (std::numeric_limits<std::int32_t>::max)())
        CHECK(next_prime(static_cast<std::int32_t>(n)) == static_cast<std::int32_t>(prime));
    CHECK(next_prime(static_cast<std::uint32_t>(n)) == static_cast<std::uint32_t>(prime));
}

TEST_CASE("next_prime agrees with a sieve up to 1 000 000", "[id][A7][H2]") {
    constexpr std::size_t last = 1'000'003;
    std::vector<bool> composite(last + 1);
    for (std::size_t d = 2; d * d <= last; ++d)
        if (!composite[d])
            for (std::size_t k = d * d; k <= last; k += d) composite[k] = true;
    std::uint64_t next = last;  // 1 000 003 is prime
    for (std::size_t n = last - 1; n + 1 > 0; --n) {
        if (next_prime(static_cast<std::uint64_t>(n)) != next) {
            FAIL("next_prime(" << n << ") is not " << next);
        }
        if (is_prime(n) != (n >= 2 && !composite[n])) FAIL("is_prime(" << n << ")");
        if (n >= 2 && !composite[n]) next = n;
    }
    SUCCEED();
}

TEST_CASE("no prime past the largest of the type: an error, no wrap", "[id][A8][H2]") {
    const auto text =
        thrown<tsubu::limit_error>([] { static_cast<void>(next_prime((std::numeric_limits<std::int32_t>::max)())); });
    INFO(text);
    CHECK(says(text, "2147483647"));
    CHECK(says(text, "wider"));
    CHECK(next_prime(std::uint32_t{4'294'967'290}) == 4'294'967'291);
    CHECK_THROWS_AS(next_prime(std::uint32_t{4'294'967'291}), tsubu::limit_error);
    CHECK_THROWS_AS(next_prime((std::numeric_limits<std::uint32_t>::max)()), tsubu::limit_error);
    CHECK(next_prime(std::uint8_t{241}) == 251);
    CHECK_THROWS_AS(next_prime(std::uint8_t{251}), tsubu::limit_error);
    CHECK_THROWS_AS(next_prime((std::numeric_limits<std::uint64_t>::max)()), tsubu::limit_error);
}

TEST_CASE("a negative n yields 2", "[id][A7][H2]") {
    CHECK(next_prime(-1) == 2);
    CHECK(next_prime((std::numeric_limits<std::int32_t>::min)()) == 2);
    CHECK(next_prime((std::numeric_limits<std::int64_t>::min)()) == 2);
}

TEST_CASE("squares of primes are not taken for primes", "[id][A8][H2]") {
    for (std::uint64_t p = 2; p < 50'000; p = next_prime(p)) {
        if (is_prime(p * p)) FAIL(p << " squared");
        if (next_prime(p * p - 1) == p * p) FAIL("next_prime(" << p << " squared - 1)");
    }
    CHECK(next_prime(8) == 11);
    CHECK(next_prime(24) == 29);
    CHECK(next_prime(48) == 53);
    CHECK(next_prime(120) == 127);
    // 46337^2 is the last square of a prime below 2^31; d * d must not be cut off at 46340 too early.
    CHECK_FALSE(is_prime(46'337ULL * 46'337ULL));
    CHECK_FALSE(is_prime(65'521ULL * 65'521ULL));
}

TEST_CASE("near 2^31 the work is that of 23 000 divisions for each candidate", "[id][A8][H2]") {
    // Below 1 ms by work, not by the clock: a prime p needs the odd d up to sqrt p, and the longest gap between
    // primes below 2^32 is 336, of which most candidates fall to a small d.
    std::uint64_t divisions = 0;
    const std::uint64_t from = 2'147'483'629;
    for (auto p = from + 2; p <= next_prime(from); p += 2)
        for (std::uint64_t d = 3; d * d <= p; d += 2) {
            ++divisions;
            if (p % d == 0) break;
        }
    CHECK(divisions < 50'000);  // at 10 ns each: half a millisecond
}

TEST_CASE("the formula as printed never finds a prime from an even n", "[id][A8][H2]") {
    const auto n = GENERATE(std::uint64_t{2}, std::uint64_t{4}, std::uint64_t{1000}, std::uint64_t{32'768});
    bool any = false;
    for (std::uint64_t candidate = n + 2; candidate < n + 10'000; candidate += 2) any = any || is_prime(candidate);
    CHECK_FALSE(any);
    CHECK(next_prime(n) % 2 == 1);
}

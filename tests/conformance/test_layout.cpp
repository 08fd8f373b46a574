// SPDX-License-Identifier: MIT
/// @file
/// The layouts that are shipped, and broken ones that the suite must catch by the number of their law.
#include <tsubu/testing/layout_conformance.hpp>

#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/soa.hpp>

#include "support/catch.hpp"

#include <cstddef>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

namespace {

using tsubu::soa;

/// The laws that were broken, and the first text.
struct layout_verdict {
    void operator()(bool kept, std::string_view law) {
        ++checked;
        if (kept) return;
        if (broken.empty()) first = law;
        broken.insert(std::string(law.substr(0, 5)));
    }
    std::size_t checked = 0;
    std::set<std::string> broken;
    std::string first;
};

/// Values 0 of rows 2 i and 2 i + 1 lie in the same place.
struct rows_share_a_value {
    static constexpr const char* breaks = "law 1";
    template <class Value>
    struct halved_place {
        Value* start;
        std::size_t first = 0;
        Value& at(std::size_t i) const noexcept { return start[(first + i) / 2]; }
        halved_place from(std::size_t i) const noexcept { return {start, first + i}; }
    };
    template <class... Values>
    struct memory : soa::memory<Values...> {
        using base = soa::memory<Values...>;
        template <std::size_t K>
        auto place() noexcept {
            return halved_place<typename base::template value<K>>{base::template place<K>().start};
        }
        template <std::size_t K>
        auto place() const noexcept {
            return halved_place<const typename base::template value<K>>{base::template place<K>().start};
        }
        template <std::size_t K>
        auto& at(std::size_t i) noexcept {
            return place<K>().at(i);
        }
        template <std::size_t K>
        auto& at(std::size_t i) const noexcept {
            return place<K>().at(i);
        }
    };
};
/// The rest of a column begins one row late.
struct place_is_late {
    static constexpr const char* breaks = "law 2";
    template <class Value>
    struct late_place {
        Value* start;
        Value& at(std::size_t i) const noexcept { return start[i]; }
        late_place from(std::size_t i) const noexcept { return {start + i + (i > 1 ? 1 : 0)}; }
    };
    template <class... Values>
    struct memory : soa::memory<Values...> {
        using base = soa::memory<Values...>;
        template <std::size_t K>
        auto place() noexcept {
            return late_place<typename base::template value<K>>{base::template place<K>().start};
        }
        template <std::size_t K>
        auto place() const noexcept {
            return late_place<const typename base::template value<K>>{base::template place<K>().start};
        }
    };
};
struct copy_forgets_the_last_value {
    static constexpr const char* breaks = "law 3";
    template <class... Values>
    struct memory : soa::memory<Values...> {
        void copy_row(std::size_t from, std::size_t to) noexcept {
            constexpr auto last = sizeof...(Values) - 1;
            const auto before = this->template at<last>(to);
            soa::memory<Values...>::copy_row(from, to);
            this->template at<last>(to) = before;
        }
    };
};
struct swap_copies {
    static constexpr const char* breaks = "law 3";
    template <class... Values>
    struct memory : soa::memory<Values...> {
        void swap_rows(std::size_t i, std::size_t j) noexcept { this->copy_row(i, j); }
    };
};
/// What is to be at i goes to order[i]: the inverse.
struct gather_scatters {
    static constexpr const char* breaks = "law 4";
    template <class... Values>
    struct memory : soa::memory<Values...> {
        template <class Index>
        void gather(const Index* order, std::size_t count) {
            const memory before = *this;
            for (std::size_t i = 0; i < count; ++i) {
                const auto to = static_cast<std::size_t>(order[i]);
                copy_from(before, i, to, std::index_sequence_for<Values...>{});
            }
        }
        template <std::size_t... K>
        void copy_from(const memory& other, std::size_t from, std::size_t to, std::index_sequence<K...>) {
            ((this->template at<K>(to) = other.template at<K>(from)), ...);
        }
    };
};
/// In place: what an earlier row has taken over is taken as it is now.
struct gather_reads_what_it_wrote {
    static constexpr const char* breaks = "law 4";
    template <class... Values>
    struct memory : soa::memory<Values...> {
        template <class Index>
        void gather(const Index* order, std::size_t count) {
            for (std::size_t i = 0; i < count; ++i) this->copy_row(static_cast<std::size_t>(order[i]), i);
        }
    };
};
struct keeps_one_row_less {
    static constexpr const char* breaks = "law 5";
    template <class... Values>
    struct memory : soa::memory<Values...> {
        void reallocate(std::size_t capacity, std::size_t kept) {
            if (kept == 0) return soa::memory<Values...>::reallocate(capacity, kept);
            const auto before = *this;
            soa::memory<Values...>::reallocate(capacity, kept);
            this->copy_row(0, kept - 1);
        }
    };
};
struct room_for_one_less {
    static constexpr const char* breaks = "law 5";
    template <class... Values>
    struct memory : soa::memory<Values...> {
        [[nodiscard]] std::size_t capacity() const noexcept {
            const auto held = soa::memory<Values...>::capacity();
            return held == 64 ? 63 : held;
        }
    };
};
struct takes_twice {
    static constexpr const char* breaks = "law 6";
    template <class... Values>
    struct memory : soa::memory<Values...> {
        [[nodiscard]] std::size_t memory_bytes() const noexcept { return 2 * soa::memory<Values...>::memory_bytes(); }
    };
};
struct copies_share {
    static constexpr const char* breaks = "law 7";
    template <class... Values>
    class memory {
        using held = soa::memory<Values...>;

    public:
        template <std::size_t K>
        auto& at(std::size_t i) noexcept {
            return held_->template at<K>(i);
        }
        template <std::size_t K>
        const auto& at(std::size_t i) const noexcept {
            return std::as_const(*held_).template at<K>(i);
        }
        template <std::size_t K>
        auto place() noexcept {
            return held_->template place<K>();
        }
        template <std::size_t K>
        auto place() const noexcept {
            return std::as_const(*held_).template place<K>();
        }
        [[nodiscard]] std::size_t capacity() const noexcept { return held_->capacity(); }
        [[nodiscard]] std::size_t memory_bytes() const noexcept { return held_->memory_bytes(); }
        void reallocate(std::size_t capacity, std::size_t kept) { held_->reallocate(capacity, kept); }
        void copy_row(std::size_t from, std::size_t to) noexcept { held_->copy_row(from, to); }
        void swap_rows(std::size_t i, std::size_t j) noexcept { held_->swap_rows(i, j); }
        template <class Index>
        void gather(const Index* order, std::size_t count) {
            held_->gather(order, count);
        }

    private:
        std::shared_ptr<held> held_ = std::make_shared<held>();
    };
};

}  // namespace

TEMPLATE_TEST_CASE("a shipped layout keeps the seven laws", "[store][conformance]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<1>, tsubu::aosoa<5>, tsubu::aosoa<16>, tsubu::aosoa<64>) {
    layout_verdict seen;
    tsubu::testing::check_layout<TestType>(4, 2000, seen);
    INFO(seen.first);
    CHECK(seen.broken.empty());
    CHECK(seen.checked > 6000);
}

TEMPLATE_TEST_CASE("a broken layout is caught by the number of its law", "[store][conformance]", rows_share_a_value,
                   place_is_late, copy_forgets_the_last_value, swap_copies, gather_scatters, gather_reads_what_it_wrote,
                   keeps_one_row_less, room_for_one_less, takes_twice, copies_share) {
    static_assert(tsubu::particle_layout<TestType>);
    layout_verdict seen;
    tsubu::testing::check_layout<TestType>(1, 500, seen);
    INFO("breaks " << TestType::breaks << ", first caught: " << seen.first);
    CHECK(seen.broken.count(TestType::breaks) == 1);
    CHECK(seen.first.substr(0, 5) == TestType::breaks);
    CHECK(seen.first.find("seed 1") != std::string::npos);
}

// SPDX-License-Identifier: MIT
/// @file
/// Any transport, which counts what goes over it to other ranks.
#pragma once

#include <tsubu/comm/local_transport.hpp>
#include <tsubu/comm/mailbox.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/types.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint64_t
#include <span>     // std::span
#include <vector>   // std::vector

namespace bench {

/// What one rank has sent.
struct traffic {
    std::uint64_t messages = 0;    ///< to other ranks
    std::uint64_t bytes = 0;       ///< in them
    std::uint64_t reductions = 0;  ///< that it has taken part in, by exchange and reduce
};

template <tsubu::transport Transport>
class counting_transport {
public:
    explicit counting_transport(Transport& on) noexcept : on_(&on) {}

    [[nodiscard]] const traffic& sent() const noexcept { return sent_; }
    void clear() noexcept { sent_ = {}; }

    [[nodiscard]] tsubu::rank_t rank() const noexcept { return on_->rank(); }
    [[nodiscard]] std::size_t ranks() const noexcept { return on_->ranks(); }
    [[nodiscard]] tsubu::mailbox exchange(std::span<const tsubu::parcel> parcels, std::span<std::uint64_t> sums) {
        for (const auto& one : parcels) count(one.rank, one.words.size());
        ++sent_.reductions;
        return on_->exchange(parcels, sums);
    }
    void reduce(std::span<std::uint64_t> numbers, tsubu::reduction how) {
        ++sent_.reductions;
        on_->reduce(numbers, how);
    }
    void reduce(std::span<double> numbers, tsubu::reduction how) {
        ++sent_.reductions;
        on_->reduce(numbers, how);
    }
    [[nodiscard]] tsubu::mailbox gather(std::span<const std::uint64_t> words) { return on_->gather(words); }
    [[nodiscard]] std::uint64_t sum_before(std::uint64_t n) { return on_->sum_before(n); }
    [[nodiscard]] int next_tag() noexcept { return on_->next_tag(); }
    [[nodiscard]] tsubu::message_memory& memory() noexcept { return on_->memory(); }

    class channel {
    public:
        channel(counting_transport& on, int tag, const std::vector<tsubu::lane>& out,
                const std::vector<tsubu::lane>& in)
            : counted_(&on), out_(out), way_(*on.on_, tag, out, in) {}
        [[nodiscard]] std::span<std::uint64_t> out() noexcept { return way_.out(); }
        [[nodiscard]] std::span<const std::uint64_t> in() const noexcept { return way_.in(); }
        void start() {
            for (const auto& one : out_) counted_->count(one.rank, one.words);
            way_.start();
        }
        void finish() { way_.finish(); }

    private:
        counting_transport* counted_;
        std::vector<tsubu::lane> out_;
        typename Transport::channel way_;
    };

private:
    void count(tsubu::rank_t to, std::size_t words) noexcept {
        if (to == rank()) return;
        ++sent_.messages;
        sent_.bytes += 8 * words;
    }

    Transport* on_;
    traffic sent_;
};
static_assert(tsubu::transport<counting_transport<tsubu::local_transport>>);

}  // namespace bench

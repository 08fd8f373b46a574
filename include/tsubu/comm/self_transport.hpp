// SPDX-License-Identifier: MIT
/// @file
/// self_transport: one rank, without MPI.
#pragma once

#include <tsubu/comm/detail/rank_checks.hpp>
#include <tsubu/comm/mailbox.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/types.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint64_t
#include <span>     // std::span
#include <vector>   // std::vector

namespace tsubu {

/// A simulation in one process: the only rank is 0, and what it sends it gets itself, such as its periodic images.
///
///     tsubu::self_transport on;
///     tsubu::migrate(particles, parts, on);
///
/// Concept: transport. Cost: a copy of what is sent. Deterministic: yes.
/// Choose it when the program runs in one process. Do not when it runs under mpirun: each process would be rank 0 of 1.
class self_transport {
public:
    [[nodiscard]] rank_t rank() const noexcept { return 0; }
    [[nodiscard]] std::size_t ranks() const noexcept { return 1; }

    /// @throws input_error if a parcel is for another rank.
    [[nodiscard]] mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t>) {
        mailbox came(memory_);
        for (const auto& one : parcels) {
            detail::check_parcel("self_transport::exchange", one, ranks());
            came.add(one);
        }
        return came;
    }
    template <class Number>
    void reduce(std::span<Number>, reduction) noexcept {}
    [[nodiscard]] mailbox gather(std::span<const std::uint64_t> words) {
        mailbox came(memory_);
        came.add(parcel{0, words});
        return came;
    }
    [[nodiscard]] std::uint64_t sum_before(std::uint64_t) noexcept { return 0; }
    [[nodiscard]] int next_tag() noexcept { return 0; }
    [[nodiscard]] message_memory& memory() noexcept { return memory_; }

    /// There is no other rank to bring anything to.
    class channel {
    public:
        channel(self_transport&, int, const std::vector<lane>&, const std::vector<lane>&) noexcept {}
        [[nodiscard]] std::span<std::uint64_t> out() noexcept { return {}; }
        [[nodiscard]] std::span<const std::uint64_t> in() const noexcept { return {}; }
        void start() noexcept {}
        void finish() noexcept {}
    };

private:
    message_memory memory_;
};
static_assert(transport<self_transport>);

}  // namespace tsubu

// SPDX-License-Identifier: MIT
/// @file
/// Transports that break one law each, as real ones do: the conformance suite must catch every one.
#pragma once

#include <tsubu/comm/local_transport.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace tsubu::testing::broken {

/// What the twins share: everything right.
struct sound_transport : local_transport {
    explicit sound_transport(const local_transport& on) : local_transport(on) {}
};

// --- law 1 ----------------------------------------------------------------------------------------------------------

struct loses_empty_parcels : sound_transport {
    static constexpr const char* breaks = "law 1";
    using sound_transport::sound_transport;
    mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) {
        std::vector<parcel> some(parcels.begin(), parcels.end());
        std::erase_if(some, [](const parcel& one) { return one.words.empty(); });
        return sound_transport::exchange(some, sums);
    }
};
struct doubles_a_parcel : sound_transport {
    static constexpr const char* breaks = "law 1";
    using sound_transport::sound_transport;
    mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) {
        std::vector<parcel> more(parcels.begin(), parcels.end());
        if (more.size() > 2) more.insert(more.begin() + 1, parcel(more.front()));
        return sound_transport::exchange(more, sums);
    }
};
/// As messages that overtake each other.
struct turns_the_order_of_a_sender : sound_transport {
    static constexpr const char* breaks = "law 1";
    using sound_transport::sound_transport;
    mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) {
        std::vector<parcel> turned(parcels.rbegin(), parcels.rend());
        return sound_transport::exchange(turned, sums);
    }
};
/// In the order of arrival.
struct does_not_sort : sound_transport {
    static constexpr const char* breaks = "law 1";
    using sound_transport::sound_transport;
    mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) {
        const auto came = sound_transport::exchange(parcels, sums);
        mailbox mixed;
        for (std::size_t k = came.size(); k-- > 0;)
            if (came[k].rank % 2 == 1) mixed.add(came[k]);
        for (const auto& one : came)
            if (one.rank % 2 == 0) mixed.add(one);
        return mixed;
    }
};
/// What is for one rank goes as one message, and comes as one parcel.
struct joins_parcels : sound_transport {
    static constexpr const char* breaks = "law 1";
    using sound_transport::sound_transport;
    mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) {
        const auto came = sound_transport::exchange(parcels, sums);
        mailbox joined;
        for (std::size_t k = 0; k < came.size();) {
            std::vector<std::uint64_t> words;
            const auto from = came[k].rank;
            for (; k < came.size() && came[k].rank == from; ++k)
                words.insert(words.end(), came[k].words.begin(), came[k].words.end());
            joined.add(parcel{from, words});
        }
        return joined;
    }
};
/// The pieces of a long message are not joined.
struct cuts_long_parcels : sound_transport {
    static constexpr const char* breaks = "law 1";
    using sound_transport::sound_transport;
    mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) {
        constexpr std::size_t most = 64;
        std::vector<parcel> pieces;
        for (auto one : parcels) {
            for (; one.words.size() > most; one.words = one.words.subspan(most))
                pieces.push_back({one.rank, one.words.first(most)});
            pieces.push_back(one);
        }
        return sound_transport::exchange(pieces, sums);
    }
};
struct forgets_the_sums_of_one_rank : sound_transport {
    static constexpr const char* breaks = "law 1";
    using sound_transport::sound_transport;
    mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) {
        const std::vector<std::uint64_t> mine(sums.begin(), sums.end());
        auto came = sound_transport::exchange(parcels, sums);
        if (rank() == 1) std::copy(mine.begin(), mine.end(), sums.begin());
        return came;
    }
};
/// Through double: 53 bits of 64.
struct rounds_sums : sound_transport {
    static constexpr const char* breaks = "law 1";
    using sound_transport::sound_transport;
    mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) {
        for (auto& one : sums) one &= ~std::uint64_t{0x7ff};
        return sound_transport::exchange(parcels, sums);
    }
};

// --- law 2 ----------------------------------------------------------------------------------------------------------

/// A word past 2^63 is less than 0.
struct signed_words : sound_transport {
    static constexpr const char* breaks = "law 2";
    using sound_transport::sound_transport;
    using sound_transport::reduce;
    void reduce(std::span<std::uint64_t> numbers, reduction how) {
        constexpr auto half = std::uint64_t{1} << 63;
        if (how == reduction::sum) return sound_transport::reduce(numbers, how);
        for (auto& one : numbers) one ^= half;
        sound_transport::reduce(numbers, how);
        for (auto& one : numbers) one ^= half;
    }
};
struct knows_only_sums : sound_transport {
    static constexpr const char* breaks = "law 2";
    using sound_transport::sound_transport;
    using sound_transport::reduce;
    void reduce(std::span<double> numbers, reduction) { sound_transport::reduce(numbers, reduction::sum); }
};
/// Each rank begins with its own number.
struct sums_in_another_order : sound_transport {
    static constexpr const char* breaks = "law 2";
    using sound_transport::sound_transport;
    using sound_transport::reduce;
    void reduce(std::span<double> numbers, reduction how) {
        if (how != reduction::sum) return sound_transport::reduce(numbers, how);
        std::vector<std::uint64_t> bits;
        for (const auto one : numbers) bits.push_back(std::bit_cast<std::uint64_t>(one));
        const auto all = gather(bits);
        for (std::size_t k = 0; k < numbers.size(); ++k)
            for (std::size_t on = 1; on < ranks(); ++on)
                numbers[k] += std::bit_cast<double>(all[(rank() + on) % ranks()].words[k]);
    }
};

// --- law 3 ----------------------------------------------------------------------------------------------------------

struct gathers_from_itself_on : sound_transport {
    static constexpr const char* breaks = "law 3";
    using sound_transport::sound_transport;
    mailbox gather(std::span<const std::uint64_t> words) {
        const auto all = sound_transport::gather(words);
        if (words.size() < 3) return all;
        mailbox turned;
        for (std::size_t k = 0; k < ranks(); ++k) turned.add(all[(rank() + k) % ranks()]);
        return turned;
    }
};
/// As MPI_Allgather, which knows one length.
struct gathers_one_length : sound_transport {
    static constexpr const char* breaks = "law 3";
    using sound_transport::sound_transport;
    mailbox gather(std::span<const std::uint64_t> words) {
        const auto all = sound_transport::gather(words);
        mailbox cut;
        for (const auto& one : all) cut.add({one.rank, one.words.first((std::min)(words.size(), one.words.size()))});
        return cut;
    }
};

// --- law 4 ----------------------------------------------------------------------------------------------------------

struct sum_with_its_own : sound_transport {
    static constexpr const char* breaks = "law 4";
    using sound_transport::sound_transport;
    std::uint64_t sum_before(std::uint64_t n) { return sound_transport::sum_before(n) + n; }
};
/// As MPI_Exscan, which leaves rank 0 as it is.
struct nothing_for_rank_0 : sound_transport {
    static constexpr const char* breaks = "law 4";
    using sound_transport::sound_transport;
    std::uint64_t sum_before(std::uint64_t n) {
        const auto sum = sound_transport::sum_before(n);
        return rank() == 0 ? n : sum;
    }
};

// --- law 5 ----------------------------------------------------------------------------------------------------------

/// Sends what was in out() when the channel was started before.
struct sends_the_last_words : sound_transport {
    static constexpr const char* breaks = "law 5";
    using sound_transport::sound_transport;
    class channel : public local_transport::channel {
    public:
        using local_transport::channel::channel;
        void start() {
            const auto out = local_transport::channel::out();
            std::vector<std::uint64_t> fresh(out.begin(), out.end());
            if (!last_.empty()) std::copy(last_.begin(), last_.end(), out.begin());
            local_transport::channel::start();
            std::copy(fresh.begin(), fresh.end(), out.begin());
            last_ = std::move(fresh);
        }

    private:
        std::vector<std::uint64_t> last_;
    };
};
/// What came first stays.
struct reads_once : sound_transport {
    static constexpr const char* breaks = "law 5";
    using sound_transport::sound_transport;
    class channel : public local_transport::channel {
    public:
        using local_transport::channel::channel;
        [[nodiscard]] std::span<const std::uint64_t> in() const noexcept { return first_; }
        void finish() {
            local_transport::channel::finish();
            const auto in = local_transport::channel::in();
            if (first_.empty()) first_.assign(in.begin(), in.end());
        }

    private:
        std::vector<std::uint64_t> first_;
    };
};
/// Moved out, and not copied.
struct empties_what_goes_out : sound_transport {
    static constexpr const char* breaks = "law 5";
    using sound_transport::sound_transport;
    class channel : public local_transport::channel {
    public:
        using local_transport::channel::channel;
        void start() {
            local_transport::channel::start();
            const auto out = local_transport::channel::out();
            std::fill(out.begin(), out.end(), std::uint64_t{0});
        }
    };
};
/// The lanes of each channel in the order of ranks, from the last one down.
struct turns_lanes : sound_transport {
    static constexpr const char* breaks = "law 5";
    using sound_transport::sound_transport;
    class channel : public local_transport::channel {
    public:
        channel(sound_transport& on, int tag, std::vector<lane> out, std::vector<lane> in)
            : local_transport::channel(on, tag, std::move(out), turned(std::move(in))) {}

    private:
        static std::vector<lane> turned(std::vector<lane> lanes) {
            std::reverse(lanes.begin(), lanes.end());
            return lanes;
        }
    };
};
/// Counted by each rank for itself.
struct tags_of_its_own : sound_transport {
    static constexpr const char* breaks = "law 5";
    using sound_transport::sound_transport;
    int next_tag() { return sound_transport::next_tag() + static_cast<int>(rank()); }
};
struct one_tag_for_all : sound_transport {
    static constexpr const char* breaks = "law 5";
    using sound_transport::sound_transport;
    int next_tag() { return 7; }
};

using transport_twins =
    std::tuple<loses_empty_parcels, doubles_a_parcel, turns_the_order_of_a_sender, does_not_sort, joins_parcels,
               cuts_long_parcels, forgets_the_sums_of_one_rank, rounds_sums, signed_words, knows_only_sums,
               sums_in_another_order, gathers_from_itself_on, gathers_one_length, sum_with_its_own, nothing_for_rank_0,
               sends_the_last_words, reads_once, empties_what_goes_out, turns_lanes, tags_of_its_own, one_tag_for_all>;

}  // namespace tsubu::testing::broken

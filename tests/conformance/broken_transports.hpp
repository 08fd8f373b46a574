// SPDX-License-Identifier: MIT
/// @file
/// Transports that break one law each, as real ones do: the conformance suite must catch every one.
#pragma once

#include <tsubu/comm/local_transport.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace tsubu::testing::broken {

/// The channel of a twin: everything right, but what a twin overrides.
class sound_way {
public:
    sound_way(local_transport& on, int tag, std::vector<lane> out, std::vector<lane> in)
        : way_(on, tag, std::move(out), std::move(in)) {}
    sound_way(const sound_way&) = delete;
    sound_way& operator=(const sound_way&) = delete;
    virtual ~sound_way() = default;

    [[nodiscard]] std::span<std::uint64_t> out() noexcept { return way_.out(); }
    [[nodiscard]] virtual std::span<const std::uint64_t> in() const noexcept { return way_.in(); }
    virtual void start() { way_.start(); }
    virtual void finish() { way_.finish(); }

private:
    local_transport::channel way_;
};

/// What the twins share: everything right. They override it, for a suite that is compiled once for all of them.
class sound_transport {
public:
    explicit sound_transport(local_transport& on) : on_(on) {}
    sound_transport(const sound_transport&) = delete;
    sound_transport& operator=(const sound_transport&) = delete;
    virtual ~sound_transport() = default;

    [[nodiscard]] rank_t rank() const noexcept { return on_.rank(); }
    [[nodiscard]] std::size_t ranks() const noexcept { return on_.ranks(); }
    [[nodiscard]] virtual mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) {
        return on_.exchange(parcels, sums);
    }
    virtual void reduce(std::span<std::uint64_t> numbers, reduction how) { on_.reduce(numbers, how); }
    virtual void reduce(std::span<double> numbers, reduction how) { on_.reduce(numbers, how); }
    [[nodiscard]] virtual mailbox gather(std::span<const std::uint64_t> words) { return on_.gather(words); }
    [[nodiscard]] virtual std::uint64_t sum_before(std::uint64_t n) { return on_.sum_before(n); }
    [[nodiscard]] virtual int next_tag() { return on_.next_tag(); }
    [[nodiscard]] message_memory& memory() noexcept { return on_.memory(); }
    [[nodiscard]] virtual std::unique_ptr<sound_way> open(int tag, std::vector<lane> out, std::vector<lane> in) {
        return make_way<sound_way>(tag, std::move(out), std::move(in));
    }

    class channel {
    public:
        channel(sound_transport& on, int tag, std::vector<lane> out, std::vector<lane> in)
            : way_(on.open(tag, std::move(out), std::move(in))) {}
        [[nodiscard]] std::span<std::uint64_t> out() noexcept { return way_->out(); }
        [[nodiscard]] std::span<const std::uint64_t> in() const noexcept { return way_->in(); }
        void start() { way_->start(); }
        void finish() { way_->finish(); }

    private:
        std::unique_ptr<sound_way> way_;
    };

protected:
    template <class Way>
    [[nodiscard]] std::unique_ptr<sound_way> make_way(int tag, std::vector<lane> out, std::vector<lane> in) {
        return std::make_unique<Way>(on_, tag, std::move(out), std::move(in));
    }

private:
    local_transport& on_;
};
static_assert(transport<sound_transport>);

// --- law 1 ----------------------------------------------------------------------------------------------------------

struct loses_empty_parcels : sound_transport {
    static constexpr const char* breaks = "law 1";
    using sound_transport::sound_transport;
    mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) override {
        std::vector<parcel> some(parcels.begin(), parcels.end());
        std::erase_if(some, [](const parcel& one) { return one.words.empty(); });
        return sound_transport::exchange(some, sums);
    }
};
struct doubles_a_parcel : sound_transport {
    static constexpr const char* breaks = "law 1";
    using sound_transport::sound_transport;
    mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) override {
        std::vector<parcel> more(parcels.begin(), parcels.end());
        if (more.size() > 2) more.insert(more.begin() + 1, parcel(more.front()));
        return sound_transport::exchange(more, sums);
    }
};
/// As messages that overtake each other.
struct turns_the_order_of_a_sender : sound_transport {
    static constexpr const char* breaks = "law 1";
    using sound_transport::sound_transport;
    mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) override {
        std::vector<parcel> turned(parcels.rbegin(), parcels.rend());
        return sound_transport::exchange(turned, sums);
    }
};
/// In the order of arrival.
struct does_not_sort : sound_transport {
    static constexpr const char* breaks = "law 1";
    using sound_transport::sound_transport;
    mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) override {
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
    mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) override {
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
    mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) override {
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
    mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) override {
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
    mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) override {
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
    void reduce(std::span<std::uint64_t> numbers, reduction how) override {
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
    void reduce(std::span<double> numbers, reduction) override { sound_transport::reduce(numbers, reduction::sum); }
};
/// Each rank begins with its own number.
struct sums_in_another_order : sound_transport {
    static constexpr const char* breaks = "law 2";
    using sound_transport::sound_transport;
    using sound_transport::reduce;
    void reduce(std::span<double> numbers, reduction how) override {
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
    mailbox gather(std::span<const std::uint64_t> words) override {
        auto all = sound_transport::gather(words);
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
    mailbox gather(std::span<const std::uint64_t> words) override {
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
    std::uint64_t sum_before(std::uint64_t n) override { return sound_transport::sum_before(n) + n; }
};
/// As MPI_Exscan, which leaves rank 0 as it is.
struct nothing_for_rank_0 : sound_transport {
    static constexpr const char* breaks = "law 4";
    using sound_transport::sound_transport;
    std::uint64_t sum_before(std::uint64_t n) override {
        const auto sum = sound_transport::sum_before(n);
        return rank() == 0 ? n : sum;
    }
};

// --- law 5 ----------------------------------------------------------------------------------------------------------

/// Sends what was in out() when the channel was started before.
struct sends_the_last_words : sound_transport {
    static constexpr const char* breaks = "law 5";
    using sound_transport::sound_transport;
    struct way : sound_way {
        using sound_way::sound_way;
        void start() override {
            std::vector<std::uint64_t> fresh(out().begin(), out().end());
            if (!last.empty()) std::copy(last.begin(), last.end(), out().begin());
            sound_way::start();
            std::copy(fresh.begin(), fresh.end(), out().begin());
            last = std::move(fresh);
        }
        std::vector<std::uint64_t> last;
    };
    std::unique_ptr<sound_way> open(int tag, std::vector<lane> out, std::vector<lane> in) override {
        return make_way<way>(tag, std::move(out), std::move(in));
    }
};
/// What came first stays.
struct reads_once : sound_transport {
    static constexpr const char* breaks = "law 5";
    using sound_transport::sound_transport;
    struct way : sound_way {
        using sound_way::sound_way;
        [[nodiscard]] std::span<const std::uint64_t> in() const noexcept override { return first; }
        void finish() override {
            sound_way::finish();
            const auto came = sound_way::in();
            if (first.empty()) first.assign(came.begin(), came.end());
        }
        std::vector<std::uint64_t> first;
    };
    std::unique_ptr<sound_way> open(int tag, std::vector<lane> out, std::vector<lane> in) override {
        return make_way<way>(tag, std::move(out), std::move(in));
    }
};
/// Moved out, and not copied.
struct empties_what_goes_out : sound_transport {
    static constexpr const char* breaks = "law 5";
    using sound_transport::sound_transport;
    struct way : sound_way {
        using sound_way::sound_way;
        void start() override {
            sound_way::start();
            std::fill(out().begin(), out().end(), std::uint64_t{0});
        }
    };
    std::unique_ptr<sound_way> open(int tag, std::vector<lane> out, std::vector<lane> in) override {
        return make_way<way>(tag, std::move(out), std::move(in));
    }
};
/// The lanes of each channel in the order of ranks, from the last one down.
struct turns_lanes : sound_transport {
    static constexpr const char* breaks = "law 5";
    using sound_transport::sound_transport;
    std::unique_ptr<sound_way> open(int tag, std::vector<lane> out, std::vector<lane> in) override {
        std::reverse(in.begin(), in.end());
        return sound_transport::open(tag, std::move(out), std::move(in));
    }
};
/// Counted by each rank for itself.
struct tags_of_its_own : sound_transport {
    static constexpr const char* breaks = "law 5";
    using sound_transport::sound_transport;
    int next_tag() override { return sound_transport::next_tag() + static_cast<int>(rank()); }
};
struct one_tag_for_all : sound_transport {
    static constexpr const char* breaks = "law 5";
    using sound_transport::sound_transport;
    int next_tag() override { return 7; }
};

struct transport_twin {
    const char* name;
    const char* breaks;
    std::unique_ptr<sound_transport> (*make)(local_transport&);
};
template <class Twin>
[[nodiscard]] transport_twin twin(const char* name) {
    return {name, Twin::breaks,
            [](local_transport& on) -> std::unique_ptr<sound_transport> { return std::make_unique<Twin>(on); }};
}
[[nodiscard]] inline std::vector<transport_twin> transport_twins() {
    return {twin<loses_empty_parcels>("loses_empty_parcels"),
            twin<doubles_a_parcel>("doubles_a_parcel"),
            twin<turns_the_order_of_a_sender>("turns_the_order_of_a_sender"),
            twin<does_not_sort>("does_not_sort"),
            twin<joins_parcels>("joins_parcels"),
            twin<cuts_long_parcels>("cuts_long_parcels"),
            twin<forgets_the_sums_of_one_rank>("forgets_the_sums_of_one_rank"),
            twin<rounds_sums>("rounds_sums"),
            twin<signed_words>("signed_words"),
            twin<knows_only_sums>("knows_only_sums"),
            twin<sums_in_another_order>("sums_in_another_order"),
            twin<gathers_from_itself_on>("gathers_from_itself_on"),
            twin<gathers_one_length>("gathers_one_length"),
            twin<sum_with_its_own>("sum_with_its_own"),
            twin<nothing_for_rank_0>("nothing_for_rank_0"),
            twin<sends_the_last_words>("sends_the_last_words"),
            twin<reads_once>("reads_once"),
            twin<empties_what_goes_out>("empties_what_goes_out"),
            twin<turns_lanes>("turns_lanes"),
            twin<tags_of_its_own>("tags_of_its_own"),
            twin<one_tag_for_all>("one_tag_for_all")};
}

}  // namespace tsubu::testing::broken

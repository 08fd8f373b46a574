// SPDX-License-Identifier: MIT
/// @file
/// new_ids: ids for particles that are created during a run.
#pragma once

#include <tsubu/comm/detail/agreed.hpp>
#include <tsubu/comm/detail/id_list.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>

#include <algorithm>  // std::max, std::min
#include <cstddef>    // std::size_t
#include <cstdint>    // std::int64_t, std::uint64_t
#include <limits>     // std::numeric_limits
#include <span>       // std::span
#include <string>     // std::to_string

namespace tsubu {

/// Which ids are free? Hands out each once over all ranks, in increasing order.
///
///     auto ids = tsubu::new_ids<>::above(on, grains.owned()[tsubu::id].span());
///     auto t = ids.take(on, 3);                       // this rank's are t, t + 1, t + 2
///     state.words = {ids.next()};                     // into the restart file; later: tsubu::new_ids<> ids(word)
///
/// The ids depend on how many ranks took before, not on time: a run that is repeated gives the same.
template <particle_id Id = std::int64_t>
class new_ids {
    // next() is a word, and past the last one.
    static constexpr auto last = (std::min)(static_cast<std::uint64_t>((std::numeric_limits<Id>::max)()),
                                            (std::numeric_limits<std::uint64_t>::max)() - 1);

public:
    /// The first free id, from a restart file or a program that knows; the same on all ranks.
    explicit new_ids(std::uint64_t next = 1) noexcept : next_(next) {}

    /// Above all ids that there are. @throws on all ranks or none: input_error if an id is negative; limit_error if one
    /// is 2^64 - 1.
    /// Collective: yes; two reductions.
    template <transport Transport>
    [[nodiscard]] static new_ids above(Transport& on, std::span<const Id> owned) {
        std::uint64_t next[] = {0};
        constexpr auto where = "new_ids::above";
        detail::agreed(on, where, [&] {
            detail::check_ids(where, owned);
            for (const auto t : owned) {
                const auto word = static_cast<std::uint64_t>(t);
                if (word > last)
                    detail::raise<limit_error>(where, "no number is above id " + std::to_string(t), "renumber");
                next[0] = (std::max)(next[0], word + 1);
            }
        });
        on.reduce(std::span<std::uint64_t>(next), reduction::greatest);
        return new_ids((std::max)(next[0], std::uint64_t{1}));
    }

    /// So many ids for this rank, which follow one another; the first of them. Those for no particle mean nothing.
    /// @throws limit_error on all ranks if the type of ids has not so many (2^64 - 1 is not handed out: next() could
    ///         not be past it); none is handed out then.
    /// Collective: yes, each rank with a number of its own; a reduction and a sum over the ranks below.
    template <transport Transport>
    [[nodiscard]] Id take(Transport& on, std::size_t count) {
        std::uint64_t total[] = {count};
        on.reduce(std::span<std::uint64_t>(total), reduction::sum);
        if (total[0] != 0 && (next_ > last || total[0] - 1 > last - next_))
            detail::raise<limit_error>("new_ids::take",
                                       std::to_string(total[0]) + " ids from " + std::to_string(next_) +
                                           " on, where the last is " + std::to_string(last),
                                       "renumber, or take ids of 64 bits");
        const auto first = next_ + on.sum_before(count);
        next_ += total[0];
        return static_cast<Id>(first);
    }
    /// The first free id: what a restart file must keep. The same on all ranks.
    [[nodiscard]] std::uint64_t next() const noexcept { return next_; }

private:
    std::uint64_t next_;
};

}  // namespace tsubu

// SPDX-License-Identifier: MIT
/// @file
/// skin_watch: when must neighbours be found anew?
#pragma once

#include <tsubu/comm/transport.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/domain/interval.hpp>

#include <limits>  // std::numeric_limits
#include <span>    // std::span
#include <string>  // std::to_string

namespace tsubu {

/// When must neighbours be found anew? When the fastest particles may have crossed the skin together: as soon as twice
/// the way of the fastest is longer than it. A list that was used after that is an error, not a wrong answer.
///
///     tsubu::skin_watch watch(skin);
///     watch.travel(greatest_speed * time_step);    // each step
///     if (watch.is_due(on)) { ...; watch.restart(); }
///
/// What is added up is the way of whichever particle is the fastest in each step: at least that of any particle. No
/// positions are remembered for it.
///
/// Bytes: none per particle.
class skin_watch {
public:
    /// @param skin   by how much the reach of the list exceeds that of the forces [m]
    /// @param every  looks at each so many calls of is_due, which lets lists be used too long: that is found out
    /// @throws input_error if the skin is negative or not finite, or `every` is 0.
    explicit skin_watch(double skin, unsigned every = 1) : skin_(skin), every_(every) {
        if (!(skin >= 0) || !detail::is_finite(skin))
            detail::raise<input_error>("skin_watch", "a skin of " + detail::shown(skin) + " m",
                                       "give a finite length of at least 0");
        if (every == 0) detail::raise<input_error>("skin_watch", "every = 0", "give at least 1, to look at each step");
    }

    [[nodiscard]] double skin() const noexcept { return skin_; }
    /// How far the fastest particles have gone since restart, at most [m].
    [[nodiscard]] double travelled() const noexcept { return travelled_; }
    /// No particle goes farther than this in what follows, until the next call; at least 0 [m].
    void travel(double distance) noexcept {
        travelled_ += distance;
        // The greatest of several ranks may pass over what is no number.
        if (!(travelled_ >= 0)) travelled_ = std::numeric_limits<double>::infinity();
    }
    /// Neighbours have been found.
    void restart() noexcept {
        travelled_ = used_ = looked_ = 0;
        unchecked_ = 0;
    }
    /// Whether to find neighbours before they are used again: the skin is crossed, or will be before the next look.
    /// Each call that answers no is a use of the list.
    /// @throws on all ranks: input_error if it was used after twice the way was longer than the skin.
    /// Collective: each `every`-th call, one reduction.
    template <transport Transport>
    [[nodiscard]] bool is_due(Transport& on) {
        if (++unchecked_ < every_) {
            use();
            return false;
        }
        unchecked_ = 0;
        // Before the next look there are uses after every - 1 steps, as fast as since the last look, or a quarter
        // faster. No product if there are none, nor where the way is infinite.
        const double ahead =
            every_ > 1 && travelled_ > looked_ ? 1.25 * (travelled_ - looked_) * (every_ - 1) / every_ : 0;
        looked_ = travelled_;
        double both[2] = {travelled_ + ahead, used_};
        on.reduce(std::span<double>(both), reduction::greatest);
        refuse_if_late(both[1]);
        if (!(2 * both[0] <= skin_)) return true;
        use();
        return false;
    }
    /// To be called where no is_due follows that looks: at the end of a run of steps.
    /// @throws on all ranks: input_error if the list was used after twice the way was longer than the skin.
    /// Collective: one reduction.
    template <transport Transport>
    void check(Transport& on) const {
        double used = used_;
        on.reduce(std::span<double>(&used, 1), reduction::greatest);
        refuse_if_late(used);
    }

private:
    void use() noexcept { used_ = travelled_; }
    void refuse_if_late(double travelled) const {
        if (!(2 * travelled <= skin_)) refuse_late(travelled);
    }
    [[noreturn, gnu::cold, gnu::noinline]] void refuse_late(double travelled) const {
        detail::raise<input_error>("skin_watch",
                                   "neighbours were used after the fastest particles had gone " +
                                       detail::shown(travelled) + " m each, more than half of the skin of " +
                                       detail::shown(skin_) + " m; it was looked at every " + std::to_string(every_) +
                                       " steps",
                                   "look more often, or take a thicker skin or a smaller time step: 2 v_max dt every "
                                   "is to be at most the skin");
    }

    double skin_;
    unsigned every_;
    unsigned unchecked_ = 0;
    double travelled_ = 0;
    double used_ = 0;    // how far they had gone when the list was used last
    double looked_ = 0;  // and at the last look
};

}  // namespace tsubu

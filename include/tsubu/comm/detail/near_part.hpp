// SPDX-License-Identifier: MIT
/// @file
/// Which particles of a rank are to be ghosts of another.
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/concepts.hpp>
#include <tsubu/domain/interval.hpp>
#include <tsubu/domain/subdomain.hpp>

#include <algorithm>  // std::clamp
#include <array>    // std::array
#include <cmath>    // std::abs, std::ilogb, std::ldexp
#include <cstddef>  // std::size_t
#include <cstdint>  // std::int64_t
#include <limits>   // std::numeric_limits

namespace tsubu::detail {

/// Whether the image of a point lies within the cutoff of another rank's subdomain: in a domain the distance to it is
/// at most the cutoff; in other boxes the point is within reach of it along each axis of the cell, which all points
/// within the cutoff are. Rounding lets in points that are a few units in the last place too far, and keeps out none.
template <decomposition Parts>
class near_part {
    using box_type = typename Parts::box_type;
    using real_type = typename Parts::real_type;
    static constexpr auto D = Parts::dimension;
    using real_position_type = vec<D, real_type>;

public:
    /// @param there  the subdomain that asks for ghosts
    /// @param shift  of these ghosts
    template <class Mine, class There>
    near_part(const Parts& parts, real_type cutoff, const Mine& here, const There& there, const image_shift<D>& shift)
        : box_(&parts.whole()), shift_(shift), is_round_(!reaching_box<box_type>) {
        for (std::size_t k = 0; k < D; ++k) {
            lo_[k] = there.lo()[k];
            hi_[k] = there.hi()[k];
        }
        reach_ = reach_of(parts, cutoff, here, there);
        // A power of two, by which squares neither overflow nor vanish.
        constexpr int most = std::numeric_limits<real_type>::max_exponent - 8;
        if (cutoff > 0) scale_ = std::ldexp(real_type{1}, std::clamp(-std::ilogb(cutoff), -most, most));
        limit_ = (cutoff * scale_) * (cutoff * scale_) * (1 + 4 * std::numeric_limits<real_type>::epsilon());
    }
    /// How far it reaches along each axis of the cell [D].
    [[nodiscard]] const real_position_type& reach() const noexcept { return reach_; }
    /// The same along one axis alone: what is beyond the subdomain along the others is near too.
    void only_along(std::size_t axis) noexcept {
        is_round_ = false;
        for (std::size_t k = 0; k < D; ++k)
            if (k != axis) reach_[k] = std::numeric_limits<real_type>::infinity();
    }
    /// The reach of a cutoff between two subdomains [D].
    template <class Mine, class There>
    [[nodiscard]] static real_position_type reach_of(const Parts& parts, real_type cutoff, const Mine& here,
                                                     const There& there) {
        real_position_type reach{};
        if constexpr (reaching_box<box_type>)
            reach = parts.whole().cell_reach(cutoff, here, there);
        else
            reach.fill(cutoff);
        return reach;
    }
    /// Holds all points of the cell that has() accepts, and a few more: what is to be asked first, of many at a time.
    [[nodiscard]] subdomain<D, real_type> surroundings() const noexcept {
        constexpr auto everything = std::numeric_limits<real_type>::infinity();
        std::array<interval<real_type>, D> box{};
        for (std::size_t k = 0; k < D; ++k) {
            box[k] = {lo_[k] - reach_[k] - moved(k) - slack(k), hi_[k] + reach_[k] - moved(k) + slack(k)};
        }
        if constexpr (cyclic_box<box_type>) box[0] = {-everything, everything};
        return {box, box, lo_, hi_};
    }
    /// How far images along an axis may be off by rounding.
    [[nodiscard]] real_type slack(std::size_t k) const noexcept {
        return 32 * std::numeric_limits<real_type>::epsilon() *
               (std::abs(lo_[k]) + std::abs(hi_[k]) + std::abs(moved(k)));
    }
    /// @param at  a point of the box in coordinates of its cell
    [[nodiscard]] bool has(const typename Parts::position_type& at) const noexcept {
        if constexpr (cyclic_box<box_type>) {
            // The same image by other shifts: once around, either way.
            const auto around = static_cast<std::int64_t>(box_->sectors());
            for (const auto turns : {-around, std::int64_t{0}, around})
                if (is_near(box_->cell().image(at, {shift_[0] + turns, shift_[1], shift_[2]}))) return true;
            return false;
        } else {
            return is_near(box_->cell().image(at, shift_));
        }
    }

private:
    [[nodiscard]] real_type moved(std::size_t k) const noexcept {
        return static_cast<real_type>(shift_[k]) * box_->cell().along(k).real().length();
    }
    [[nodiscard]] bool is_near(const real_position_type& x) const noexcept {
        bool is_within_reach = true;
        real_type square = 0;
        for (std::size_t k = 0; k < D; ++k) {
            const real_type below = lo_[k] - x[k];
            const real_type above = x[k] - hi_[k];
            const real_type gap = below > 0 ? below : above > 0 ? above : 0;
            square += (gap * scale_) * (gap * scale_);
            is_within_reach = is_within_reach && gap <= reach_[k] + (is_round_ ? 0 : slack(k));
        }
        return is_round_ ? square <= limit_ : is_within_reach;
    }

    const box_type* box_;
    image_shift<D> shift_;
    real_position_type lo_{};
    real_position_type hi_{};
    real_position_type reach_{};
    real_type limit_ = 0;
    real_type scale_ = 1;
    bool is_round_;
};

}  // namespace tsubu::detail

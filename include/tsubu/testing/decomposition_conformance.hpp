// SPDX-License-Identifier: MIT
/// @file
/// Does a decomposition keep the four laws of its concept? A suite for any test framework, or none.
///
///     tsubu::testing::check_decomposition(parts, 7, 1000, [](bool ok, std::string_view law) {
///         if (!ok) { std::cerr << law << '\n'; std::exit(1); }
///     });
///
/// Every law that is checked is reported, kept or not; a broken one with the point, or the rank and the cutoff, and the
/// seed that broke it behind its text. The text begins with "law" and the number that it has in domain/concepts.hpp.
#pragma once

#include <tsubu/core/random.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/domain/concepts.hpp>
#include <tsubu/testing/detail/coordinates.hpp>

#include <algorithm>    // std::sort
#include <array>        // std::array
#include <cmath>        // std::hypot, std::sqrt
#include <concepts>     // std::same_as
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int64_t
#include <limits>       // std::numeric_limits
#include <numeric>      // std::midpoint
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <type_traits>  // std::remove_cvref_t, std::remove_reference_t
#include <utility>      // std::declval
#include <vector>       // std::vector

namespace tsubu::testing {

/// The laws of decomposition as the suite reports them: a name for each text; never an object.
struct decomposition_law {
    decomposition_law() = delete;

    static constexpr const char* owned = "law 1: one rank owns a point of the domain, and none any other";
    static constexpr const char* extended = "law 1: owns_extended of one rank has any finite point";
    static constexpr const char* faces = "law 1: a rank owns its lower corner, and the point before its upper one";
    static constexpr const char* not_finite = "law 1: no rank owns what is not finite";
    static constexpr const char* owner = "law 2: owner is the rank whose owns_extended has the point";
    static constexpr const char* owner_inside = "law 2: of a point of the domain, owner is the rank that owns it";
    static constexpr const char* batch = "law 2: a batch answers as the single question does";
    static constexpr const char* complete = "law 3: who lies within the cutoff is a neighbour";
    static constexpr const char* near = "law 3: who lies beyond the cutoff, rounding aside, is no neighbour";
    static constexpr const char* increasing = "law 3: neighbours increase by rank and shift, each named once";
    static constexpr const char* not_itself = "law 3: no rank is its own neighbour without a shift";
    static constexpr const char* mutual = "law 4: if (b, s) is a neighbour of a, then (a, -s) is one of b";
};

}  // namespace tsubu::testing

namespace tsubu::detail {

template <class Decomposition, class Check>
class decomposition_examiner {
    static constexpr std::size_t D = Decomposition::dimension;
    using scalar = typename Decomposition::scalar_type;
    using real = typename Decomposition::real_type;
    using position = typename Decomposition::position_type;
    using law = testing::decomposition_law;
    using neighbors_of_rank = std::vector<neighbor_rank<D>>;
    using box_type = typename Decomposition::box_type;
    static constexpr bool is_domain =
        std::same_as<box_type, std::remove_cvref_t<decltype(std::declval<box_type>().cell())>>;

public:
    decomposition_examiner(const Decomposition& parts, std::uint64_t seed, Check& check)
        : parts_(parts), seed_(seed), random_(seed), check_(check) {
        for (std::size_t rank = 0; rank < parts.ranks(); ++rank) subdomains_.push_back(parts.subdomain(rank));
    }

    /// Every face, edge and corner of every subdomain, and what lies beside them.
    void examine_faces() {
        for (std::size_t rank = 0; rank < parts_.ranks(); ++rank) {
            std::array<std::vector<scalar>, D> along;
            position middle{};
            for (std::size_t k = 0; k < D; ++k) {
                const auto lo = subdomains_[rank].lo()[k];
                const auto hi = subdomains_[rank].hi()[k];
                middle[k] = at_real(k, std::midpoint(lo, hi));
                along[k] = {at_real(k, lo), at_real(k, hi), cell().along(k).inside().first,
                            cell().along(k).inside().last};
            }
            if constexpr (is_domain && !is_lattice<scalar>) {
                auto last = subdomains_[rank].hi();
                for (auto& coordinate : last) coordinate = before(coordinate);
                expect(subdomains_[rank].owns(subdomains_[rank].lo()) && subdomains_[rank].owns(last), law::faces,
                       [&] { return "rank " + shown(rank); });
            }
            for (std::size_t k = 0; k < D; ++k) {
                // Where owner changes, whatever the subdomain says about its faces.
                for (const bool up : {false, true}) along[k].push_back(last_of_same_owner(middle, k, up));
                for (std::size_t n = along[k].size(); n-- > 0;)
                    for (const bool up : {false, true}) along[k].push_back(beside(along[k][n], up));
                along[k].push_back(middle[k]);
                std::sort(along[k].begin(), along[k].end());
                along[k].erase(std::unique(along[k].begin(), along[k].end()), along[k].end());
            }
            position at{};
            asked_.clear();
            examine_product(along, at, 0);
            examine_batch(rank, rank + 1);
        }
    }
    /// As many points inside, beyond faces and far away.
    void examine_random(std::size_t points) {
        asked_.clear();
        for (std::size_t i = 0; i < points; ++i) {
            position x = random_point([&](std::size_t k) { return cell().along(k).inside(); });
            examine(x);
            x[random_.below(D)] = any_coordinate<scalar>(random_);
            examine(x);
            for (std::size_t k = 0; k < D; ++k) x[k] = any_coordinate<scalar>(random_);
            examine(x);
        }
        if constexpr (!is_lattice<scalar>) {
            constexpr auto infinity = std::numeric_limits<scalar>::infinity();
            for (std::size_t k = 0; k < D; ++k)
                for (const auto bad : {std::numeric_limits<scalar>::quiet_NaN(), infinity, -infinity}) {
                    position x = random_point([&](std::size_t j) { return cell().along(j).inside(); });
                    x[k] = bad;
                    asked_.push_back(x);
                    for (const auto& mine : subdomains_)
                        expect(!mine.owns(x) && !mine.owns_extended(x), law::not_finite,
                               [&] { return shown_point(x); });
                }
        }
        examine_batch(0, parts_.ranks());
    }
    /// No, small, equal, and large cutoffs.
    void examine_neighbors() {
        const auto box = parts_.whole().cell().min_extent().width;
        auto thinnest = box;
        for (const auto& mine : subdomains_)
            for (std::size_t k = 0; k < D; ++k) thinnest = (std::min)(thinnest, mine.hi()[k] - mine.lo()[k]);
        for (const auto cutoff :
             {real{0}, thinnest / 3, beside(thinnest, false), thinnest, beside(thinnest, true), thinnest * real{2.5},
              box / 2, box / 2 + box / 16, 2 * box + box / 4, (D == 1 ? 12 : 0) * box}) {
            // Large ones give every rank as neighbour of every other, many times: some ranks stand for all.
            if (cutoff <= (std::numeric_limits<real>::max)() / 4) examine_neighbors(cutoff, cutoff > box ? 4 : 16);
        }
    }

private:
    [[nodiscard]] const auto& cell() const { return parts_.whole().cell(); }
    /// A point of the box whose coordinates of the cell are in given intervals.
    template <class IntervalOf>
    [[nodiscard]] position random_point(IntervalOf&& interval_of) {
        position at{};
        for (std::size_t k = 0; k < D; ++k) {
            const auto [first, last] = interval_of(k);
            at[k] = coordinate_between(first, last, random_);
        }
        return parts_.whole().from_cell(at);
    }
    void examine(const position& x) {
        asked_.push_back(x);
        std::size_t owners = 0;
        std::size_t extended = 0;
        for (const auto& mine : subdomains_) {
            owners += mine.owns(x) ? 1U : 0U;
            extended += mine.owns_extended(x) ? 1U : 0U;
        }
        const bool inside = parts_.whole().contains(x);
        const auto owner = parts_.owner(x);
        const auto found = [&] {
            return shown_point(x) + (inside ? ", inside" : ", outside") + ": " + shown(owners) + " ranks own it, " +
                   shown(extended) + " by owns_extended; owner says rank " + shown(owner);
        };
        expect(owners == (inside ? 1U : 0U), law::owned, found);
        expect(extended == 1, law::extended, found);
        expect(owner < parts_.ranks() && subdomains_[owner].owns_extended(x), law::owner, found);
        expect(!inside || (owner < parts_.ranks() && subdomains_[owner].owns(x)), law::owner_inside, found);
    }
    /// All points that were asked one by one, at once: the answers of the ranks from `first` to before `end`, and of
    /// owner, must be the same.
    void examine_batch(std::size_t first, std::size_t end) {
        in_both_storages(asked_, [&](const points<D, const scalar>& many) {
            for (auto rank = first; rank < end; ++rank) examine_batch(subdomains_[rank], many);
        });
        std::vector<position> finite;  // of others owner is not asked
        for (const auto& x : asked_)
            if (is_finite_point(x)) finite.push_back(x);
        in_both_storages(finite, [&](const points<D, const scalar>& many) {
            std::vector<rank_t> owners(many.size());
            parts_.owner(many, owners);
            for (std::size_t i = 0; i < many.size(); ++i)
                expect(owners[i] == parts_.owner(finite[i]), law::batch, [&] { return shown_point(finite[i]); });
        });
    }
    /// body(points), as columns and as an array of vectors.
    template <class Body>
    static void in_both_storages(const std::vector<position>& some, Body&& body) {
        std::array<std::vector<scalar>, D> column;
        typename points<D, const scalar>::columns columns{};
        for (std::size_t k = 0; k < D; ++k) {
            for (const auto& x : some) column[k].push_back(x[k]);
            columns[k] = column[k];
        }
        body(points<D, const scalar>(columns));
        body(points<D, const scalar>(some));
    }
    template <class Part>
    void examine_batch(const Part& mine, const points<D, const scalar>& many) {
        const auto count = many.size();
        std::vector<unsigned char> owned(count);
        std::vector<unsigned char> extended(count);
        std::vector<index_t> left(count);
        mine.owns(many, owned);
        mine.owns_extended(many, extended);
        const auto leavers = mine.leavers(many, left);
        std::size_t leaver = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const bool is_mine = mine.owns(asked_[i]);
            const bool has_left = leaver < leavers && left[leaver] == static_cast<index_t>(i);
            expect((owned[i] != 0) == is_mine && (extended[i] != 0) == mine.owns_extended(asked_[i]) &&
                       has_left == !is_mine,
                   law::batch, [&] { return shown_point(asked_[i]); });
            leaver += has_left ? 1U : 0U;
        }
        expect(leaver == leavers, law::batch, [&] { return std::string("too many leavers"); });
    }
    [[nodiscard]] static bool is_finite_point(const position& x) {
        if constexpr (!is_lattice<scalar>)
            for (const auto coordinate : x)
                if (!is_finite(coordinate)) return false;
        return true;
    }
    void examine_product(const std::array<std::vector<scalar>, D>& along, position& at, std::size_t k) {
        if (k == D) {
            auto x = parts_.whole().from_cell(at);
            examine(x);
            if constexpr (!is_domain)  // from_cell rounds: ask around it
                for (std::size_t j = 0; j < D; ++j)
                    for (const bool up : {false, true}) {
                        const auto middle = x[j];
                        x[j] = beside(middle, up);
                        examine(x);
                        x[j] = middle;
                    }
            return;
        }
        for (const auto coordinate : along[k]) {
            at[k] = coordinate;
            examine_product(along, at, k + 1);
        }
    }
    [[nodiscard]] scalar at_real([[maybe_unused]] std::size_t k, real x) const {
        if constexpr (is_lattice<scalar>)
            return cell().along(k).from_real(x).position;
        else
            return x;
    }
    [[nodiscard]] scalar last_of_same_owner(position at, std::size_t k, bool up) const {
        const auto owner_at = [&] { return parts_.owner(parts_.whole().from_cell(at)); };
        const auto owner = owner_at();
        const auto all = is_domain ? interval<scalar>::all() : cell().along(k).inside();
        auto same = ordinal(at[k]);
        at[k] = up ? all.last : all.first;
        if (owner_at() == owner) return at[k];
        auto other = ordinal(at[k]);
        for (auto middle = std::midpoint(same, other); middle != same && middle != other;
             middle = std::midpoint(same, other)) {
            at[k] = at_ordinal<scalar>(middle);
            (owner_at() == owner ? same : other) = middle;
        }
        return at_ordinal<scalar>(same);
    }

    void examine_neighbors(real cutoff, std::size_t asked_ranks) {
        const auto ranks = parts_.ranks();
        std::vector<neighbors_of_rank> known(ranks);
        for (std::size_t rank = 0; rank < ranks; ++rank) known[rank] = parts_.neighbors(rank, cutoff);
        const auto stride = ranks / asked_ranks + 1;
        for (std::size_t rank = random_.below(stride); rank < ranks; rank += stride) {
            const auto& found = known[rank];
            const auto at = [&] { return "rank " + shown(rank) + " of " + shown(ranks) + ", cutoff " + shown(cutoff); };
            bool increase = true;
            for (std::size_t i = 1; i < found.size(); ++i) increase = increase && found[i - 1] < found[i];
            expect(increase, law::increasing, at);
            for (const auto& [other, shift] : found) {
                const bool itself = other == rank && shift == image_shift<D>{};
                expect(!itself, law::not_itself, at);
                image_shift<D> back{};
                for (std::size_t k = 0; k < D; ++k) back[k] = -shift[k];
                expect(other < ranks && has(known[other], {static_cast<rank_t>(rank), same_image(back)}), law::mutual,
                       [&, named = other] { return at() + ", neighbour " + shown(named); });
            }
            auto sorted = found;
            std::sort(sorted.begin(), sorted.end());
            if constexpr (!is_lattice<scalar>)
                if (cutoff > 0) look_around(sorted, rank, cutoff);
            if constexpr (is_domain)
                for (std::size_t other = 0; other < ranks; ++other) {
                    image_shift<D> shift{};
                    compare_images(sorted, rank, other, cutoff, shift, 0);
                }
        }
    }
    /// Steps from points of a rank as far as the cutoff in any direction: who is met there must be named.
    void look_around(const neighbors_of_rank& found, std::size_t rank, real cutoff) {
        for (int step = 0; step < 50; ++step) {
            auto x = random_point([&](std::size_t k) {
                return interval<scalar>{subdomains_[rank].lo()[k], subdomains_[rank].hi()[k]};
            });
            if (!subdomains_[rank].owns(x)) continue;  // upper faces are not
            position direction{};
            real size = 0;
            for (std::size_t k = 0; k < D; ++k) {
                direction[k] = static_cast<real>(2 * random_.unit() - 1);
                size = std::hypot(size, direction[k]);
            }
            const auto length = cutoff * static_cast<real>(random_.below(2) == 0 ? random_.unit() : 0.999);
            for (std::size_t k = 0; k < D; ++k) x[k] += direction[k] / size * length;
            const auto [y, shift] = parts_.whole().wrap(x);
            if (!parts_.whole().contains(y)) continue;
            std::size_t other = 0;
            while (other < parts_.ranks() && !subdomains_[other].owns(y)) ++other;
            if (other == parts_.ranks()) continue;  // law 1 is broken, and was told
            const auto image = same_image(shift);
            const bool itself = other == rank && image == image_shift<D>{};
            expect(itself || std::binary_search(found.begin(), found.end(),
                                                neighbor_rank<D>{static_cast<rank_t>(other), image}),
                   law::complete, [&, met = y] {
                       return "rank " + shown(rank) + ", cutoff " + shown(cutoff) + ", " + shown_point(met);
                   });
        }
    }
    /// The one name of an image that has several: in a wedge.
    [[nodiscard]] image_shift<D> same_image(const image_shift<D>& shift) const {
        if constexpr (cyclic_box<box_type>)
            return parts_.whole().same_image(shift);
        else
            return shift;
    }
    [[nodiscard]] static bool has(const neighbors_of_rank& found, const neighbor_rank<D>& wanted) {
        return std::find(found.begin(), found.end(), wanted) != found.end();
    }
    /// Every image that could be near, and one more on each side.
    void compare_images(const neighbors_of_rank& found, std::size_t rank, std::size_t other, real cutoff,
                        image_shift<D>& shift, std::size_t k) {
        if (k < D) {
            const auto& along = parts_.whole().real_axis(k);
            const auto most = along.is_periodic() ? static_cast<std::int64_t>(cutoff / along.length()) + 2 : 0;
            for (shift[k] = -most; shift[k] <= most; ++shift[k])
                compare_images(found, rank, other, cutoff, shift, k + 1);
            return;
        }
        if (other == rank && shift == image_shift<D>{}) return;
        // In units of the cutoff, or of nothing if that is 0: then gaps are 0 or too large.
        const long double unit = cutoff > 0 ? cutoff : (std::numeric_limits<real>::min)();
        long double square = 0;
        long double rounding = 0;
        for (std::size_t j = 0; j < D; ++j) {
            const auto& along = parts_.whole().real_axis(j);
            const long double moved = static_cast<long double>(shift[j]) * along.length() / unit;
            const auto face = [&](real x) { return static_cast<long double>(x) / unit; };
            const auto& a = subdomains_[rank];
            const auto& b = subdomains_[other];
            const long double gap = (std::max)(
                {face(a.lo()[j]) - face(b.hi()[j]) - moved, face(b.lo()[j]) - face(a.hi()[j]) + moved, 0.0L});
            square += gap * gap;
            rounding = (std::max)({rounding, moved, -moved, std::abs(face(along.lo())), std::abs(face(along.hi()))});
        }
        rounding = 64 * static_cast<long double>(std::numeric_limits<real>::epsilon()) * (rounding + 1);
        const long double distance = std::sqrt(square);
        const long double wanted = cutoff > 0 ? 1U : 0U;
        const auto what = [&] {
            auto text =
                "rank " + shown(rank) + " of " + shown(parts_.ranks()) + ", neighbour " + shown(other) + " shifted by";
            for (const auto n : shift) text += ' ' + shown(n);
            return text + ", cutoff " + shown(cutoff) + ", distance " + shown(static_cast<double>(distance)) + " of it";
        };
        const bool listed =
            std::binary_search(found.begin(), found.end(), neighbor_rank<D>{static_cast<rank_t>(other), shift});
        expect(listed || distance + rounding > wanted, law::complete, what);
        expect(!listed || distance <= wanted + rounding, law::near, what);
    }

    [[nodiscard]] static std::string shown_point(const position& x) {
        std::string text = "x =";
        for (const auto coordinate : x) text += ' ' + shown(coordinate);
        return text;
    }
    template <class What>
    void expect(bool kept, const char* text, What&& what) {
        if (kept) return check_(true, std::string_view(text));
        check_(false, std::string_view(std::string(text) + "; " + what() + "; seed " + shown(seed_)));
    }

    const Decomposition& parts_;
    std::uint64_t seed_;
    random_stream random_;
    Check& check_;
    std::vector<position> asked_;  // since the last batch
    std::vector<std::remove_cvref_t<decltype(std::declval<Decomposition>().subdomain(0))>> subdomains_;
};

}  // namespace tsubu::detail

namespace tsubu::testing {

/// Does this decomposition keep laws 1 to 4?
///
/// @param seed    same seed, same run, on every machine
/// @param points  random ones, of each of three kinds: inside, beyond one face, far away
/// @param check   called as check(bool kept, std::string_view law), many times per point
/// Complexity: O(ranks) per point; faces: about 10^D points per rank.
template <decomposition Decomposition, class Check>
void check_decomposition(const Decomposition& parts, std::uint64_t seed, std::size_t points, Check&& check) {
    detail::decomposition_examiner<Decomposition, std::remove_reference_t<Check>> examiner(parts, seed, check);
    examiner.examine_faces();
    examiner.examine_random(points);
    examiner.examine_neighbors();
}

/// Laws 1 and 2 alone: for many boxes and rank counts.
template <decomposition Decomposition, class Check>
void check_partition(const Decomposition& parts, std::uint64_t seed, std::size_t points, Check&& check) {
    detail::decomposition_examiner<Decomposition, std::remove_reference_t<Check>> examiner(parts, seed, check);
    examiner.examine_faces();
    examiner.examine_random(points);
}

}  // namespace tsubu::testing

// SPDX-License-Identifier: MIT
/// @file
/// read_term: a row of Bonds, Angles, Dihedrals or Impropers.
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/io/detail/row.hpp>
#include <tsubu/store/term.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::int32_t, std::int64_t
#include <string>   // std::to_string

namespace tsubu::detail {

/// `k type id1 id2 ...`; the number k has no meaning.
template <std::size_t Order, class Row>
[[nodiscard]] term<Order> read_term(Row& from, std::int32_t types, bool allows_repeats) {
    term<Order> one;
    static_cast<void>(from.template next<std::int64_t>("the row number"));
    one.type = from.template next_from<std::int32_t>(1, "the type");
    if (one.type > types) [[unlikely]]
        from.fail("type " + std::to_string(one.type) + ", but the header has " + std::to_string(types) +
                      " of this kind",
                  "correct one of them");
    for (auto& particle : one.ids) particle = from.template next_from<std::int64_t>(1, "the id");
    from.expect_end();
    for (std::size_t k = 1; k < Order && !allows_repeats; ++k)
        for (std::size_t j = 0; j < k; ++j)
            if (one.ids[j] == one.ids[k]) [[unlikely]]
                from.fail("the id " + std::to_string(one.ids[k]) + " twice in a term",
                          "a term joins different particles; allow repeats by option if that is meant");
    return one;
}

/// What an id_map says of the particles of one term, asked before.
template <std::size_t Order>
class places_of_term {
public:
    using id_type = std::int64_t;
    /// @param places  [Order]
    places_of_term(const term<Order>& one, const index_t* places) noexcept : one_(&one), places_(places) {}
    [[nodiscard]] index_t find(id_type particle) const noexcept {
        for (std::size_t k = 0; k < Order; ++k)
            if (one_->ids[k] == particle) return places_[k];
        return absent;
    }

private:
    const term<Order>* one_;
    const index_t* places_;
};

}  // namespace tsubu::detail

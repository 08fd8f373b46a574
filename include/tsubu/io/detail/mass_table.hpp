// SPDX-License-Identifier: MIT
/// @file
/// mass_table: the rows of the section Masses, which come in any order.
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/id/id_map.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::int32_t
#include <string>   // std::to_string
#include <utility>  // std::pair
#include <vector>   // std::vector

namespace tsubu::detail {

/// Its memory follows from the rows that there are, not from what a header promises.
class mass_table {
public:
    template <class Row>
    void add(Row& from, std::int32_t types) {
        const auto type = from.template next_from<std::int32_t>(1, "the type");
        if (type > types)
            from.fail("type " + std::to_string(type) + ", but the header has " + std::to_string(types) + " atom types",
                      "correct one of them");
        const auto value = from.template next<double>("the mass");
        from.expect_end();
        if (!(value > 0)) from.fail("a mass that is not above 0", "give a mass above 0");
        if (known_.contains(type)) from.fail("a second mass of type " + std::to_string(type), "leave one of them");
        known_.assign(type, static_cast<index_t>(rows_.size()));
        rows_.emplace_back(type, value);
    }
    /// [types], once there is a row of each.
    [[nodiscard]] std::vector<double> by_type() const {
        std::vector<double> masses(rows_.size());
        for (const auto& [type, value] : rows_) masses[static_cast<std::size_t>(type - 1)] = value;
        return masses;
    }

private:
    std::vector<std::pair<std::int32_t, double>> rows_;
    id_map<> known_;
};

}  // namespace tsubu::detail

// SPDX-License-Identifier: MIT
#include <tsubu/tsubu.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

inline constexpr tsubu::field<"temperature", double, "K"> temperature{};  // fields of one's own: a line each
struct contact {
    std::int64_t with;
    double overlap;
};
inline constexpr tsubu::field<"contacts", tsubu::list_of<contact>> contacts{};  // as many as each particle has

using carried = tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::velocity<3>, temperature, contacts>;
using grains = tsubu::particle_store<carried>;  // or <carried, tsubu::aos>, <carried, tsubu::aosoa<16>>: same program

int main() {
    grains g;
    for (int i = 0; i < 3; ++i) g.push_back(tsubu::id = 7 - i, tsubu::position<3> = {0.1 * i, 0, 0}, temperature = 300);
    for (auto& v : g[tsubu::velocity<3>]) v[2] -= 9.81 * 1e-5;
    g[contacts][1].push_back({.with = 7, .overlap = 1e-6});
    const auto by_id = [](const auto& a, const auto& b) { return a[tsubu::id] < b[tsubu::id]; };
    std::sort(g.owned().begin(), g.owned().end(), by_id);  // contacts stay with their particles

    const std::vector<tsubu::index_t> chosen = {0, 1};  // all fields of these as 64-bit words, for a message
    std::vector<std::uint64_t> words(tsubu::packed_words(g, carried{}, chosen));
    tsubu::pack(g, carried{}, chosen, words);
    grains other;
    tsubu::unpack(other, carried{}, other.add_owned(chosen.size()), chosen.size(), words);
    g.swap_remove(0);  // the last one moves into the hole
    return other[tsubu::id][1] == 6 && other[contacts][1][0].with == 7 && g[tsubu::id][0] == 7 ? 0 : 1;
}

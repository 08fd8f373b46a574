// SPDX-License-Identifier: MIT
#include <tsubu/store/aos.hpp>
#include <tsubu/store/pack.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>
#include <tsubu/store/term.hpp>

#include <cstdint>
#include <string>
#include <vector>

inline constexpr tsubu::field<"temperature", double, "K"> temperature{};
struct ellipsoid {
    double a, b, c;
};
inline constexpr tsubu::field<"shape", tsubu::bonus_of<ellipsoid>> shape{};

#if CASE == 1 || CASE == 2 || CASE == 3
using set = tsubu::fields<tsubu::id>;
#elif CASE == 4
using set = tsubu::fields<tsubu::id, temperature, tsubu::field<"label", std::string>{}>;
#elif CASE == 5
using set = tsubu::fields<tsubu::id, temperature, tsubu::field<"labels", tsubu::list_of<std::string>>{}>;
#elif CASE == 6
using set = tsubu::fields<tsubu::id, temperature, 3>;
#elif CASE == 9
using set = tsubu::fields<tsubu::id, temperature, tsubu::id>;
#elif CASE == 11
using set = tsubu::fields<tsubu::id, temperature, tsubu::field<"temperature", float>{}>;
#elif CASE == 10 || CASE == 12 || CASE == 15
using set = tsubu::fields<tsubu::id, temperature, tsubu::bonds>;
#elif CASE == 13 || CASE == 14
using set = tsubu::fields<tsubu::id, temperature, shape>;
#else
using set = tsubu::fields<tsubu::id, temperature>;
#endif

int main() {
    tsubu::particle_store<set, tsubu::aos> g;
#if CASE == 1
    g.push_back(temperature = 300);
#elif CASE == 2
    g[temperature][0] = 300;
#elif CASE == 3
    std::vector<std::uint64_t> words(10);
    tsubu::pack(g, tsubu::fields<tsubu::id, temperature>{}, std::vector<tsubu::index_t>{0}, words);
#elif CASE == 7
    const auto& read = g;
    read[temperature][0] = 300;
#elif CASE == 10
    const auto& read = g;
    const decltype(g)::record held = read[0];
#elif CASE == 15
    g.push_back(tsubu::id = 1, tsubu::bonds = {{.type = 1, .ids = {1, 2}}});
#elif CASE == 12
    g.push_back(tsubu::id = 1, tsubu::bonds = std::vector<tsubu::term<2>>(2));
#elif CASE == 13
    g.push_back(tsubu::id = 1, shape = {1, 2, 3});
#elif CASE == 14
    g.push_back(tsubu::id = 1, shape = ellipsoid{1, 2, 3});
#elif CASE == 8
    tsubu::term<5> one;
#else
    g.push_back(temperature = 300, tsubu::id = 1);
    g[temperature][0] = 301;
#endif
    return g.size() == 1 ? 0 : 1;
}

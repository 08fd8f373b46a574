// SPDX-License-Identifier: MIT
/// @file
/// What an H5MD file does not take. Without CASE: the control.
#include <tsubu/hdf5.hpp>

struct shape_of {
    float axes[3];
};
inline constexpr tsubu::field<"contacts", tsubu::list_of<int>> contacts{};
inline constexpr tsubu::field<"shape", shape_of> shape{};
inline constexpr tsubu::field<"speed/max", double> odd{};
inline constexpr tsubu::field<"id", double> real_id{};

using set = tsubu::fields<tsubu::id, tsubu::position<3>>;
#if !defined(CASE)
using written = set;
#elif CASE == 1
using written = tsubu::fields<tsubu::id, contacts>;
#elif CASE == 2
using written = tsubu::fields<tsubu::id, shape>;
#elif CASE == 3
using written = tsubu::fields<tsubu::position<3>, tsubu::position<3, float>>;
#elif CASE == 4
using written = tsubu::fields<odd>;
#elif CASE == 5
using written = tsubu::fields<real_id>;
#elif CASE == 6
using written = tsubu::fields<tsubu::id, tsubu::image<3>>;
#elif CASE == 8
using written = tsubu::fields<tsubu::id, tsubu::radius>;
#else
using written = set;
#endif

void write(const tsubu::particle_store<set>& g, tsubu::particle_store<set>& again) {
#if defined(CASE) && CASE == 7
    const tsubu::domain<2> box({0, 0}, {1, 1});
#elif defined(CASE) && CASE == 10
    const int box = 1;
#else
    const tsubu::domain<3> box({0, 0, 0}, {1, 1, 1});
#endif
    tsubu::h5md_writer<written> file("run.h5", box);
    file.append(1, 0.5, g, box);
#if defined(CASE) && CASE == 9
    tsubu::h5md_reader("run.h5").read(0, again, tsubu::fields<tsubu::radius>{});
#else
    tsubu::h5md_reader("run.h5").read(0, again, set{});
#endif
}

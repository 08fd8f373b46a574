// SPDX-License-Identifier: MIT
/// @file
/// Stores of every layout and of fields of every kind, each with all of its members; and what a set of fields costs.
#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/curve.hpp>
#include <tsubu/store/pack.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/soa.hpp>
#include <tsubu/store/standard_fields.hpp>
#include <tsubu/store/topology.hpp>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <type_traits>

inline constexpr tsubu::field<"history", tsubu::list_of<double>> history{};
inline constexpr tsubu::field<"shape", tsubu::bonus_of<tsubu::vec<3>>> shape{};
inline constexpr tsubu::field<"flag", std::byte> flag{};

using flat =
    tsubu::fields<tsubu::id, tsubu::position<2>, tsubu::velocity<2>, tsubu::force<2>, tsubu::radius, tsubu::mass>;
using rich = tsubu::fields<flag, tsubu::id, tsubu::species, tsubu::position<3, float>, tsubu::bonds, history, shape>;
using one = tsubu::fields<tsubu::radius>;

#define TSUBU_TEST_STORES(...)                                                         \
    template class tsubu::particle_store<__VA_ARGS__, tsubu::soa>;                     \
    template class tsubu::particle_store<__VA_ARGS__, tsubu::aos, tsubu::block_growth>; \
    template class tsubu::particle_store<__VA_ARGS__, tsubu::aosoa<16>>;               \
    template class tsubu::particle_store<__VA_ARGS__, tsubu::aosoa<5>>

TSUBU_TEST_STORES(flat);
TSUBU_TEST_STORES(rich);
TSUBU_TEST_STORES(one);

// Not of what has members for some arguments only: clang before 16 instantiates those all the same.
#define TSUBU_TEST_VIEWS(...)                                                     \
    template class tsubu::particle_reference<tsubu::particle_store<__VA_ARGS__>>; \
    template class tsubu::particle_range<tsubu::particle_store<__VA_ARGS__>>;     \
    template class tsubu::particle_range<const tsubu::particle_store<__VA_ARGS__>>

TSUBU_TEST_VIEWS(flat, tsubu::soa);
TSUBU_TEST_VIEWS(rich, tsubu::aos);
TSUBU_TEST_VIEWS(rich, tsubu::aosoa<16>);

template class tsubu::column<double, tsubu::contiguous_place<double>>;
template class tsubu::column<const double, tsubu::contiguous_place<const double>>;
template class tsubu::list_reference<double>;
template class tsubu::list_column<double, tsubu::contiguous_place<tsubu::detail::list_extent>>;

template struct tsubu::topology<tsubu::bonds, tsubu::newton_on>;
template struct tsubu::topology<tsubu::bonds, tsubu::newton_off>;
template struct tsubu::topology<tsubu::angles, tsubu::newton_on>;
template struct tsubu::topology<tsubu::dihedrals, tsubu::newton_off>;
template struct tsubu::topology<tsubu::impropers, tsubu::newton_on>;

// A frictionless set in two dimensions: no third component, no spin, no torque, no history; and no byte for them.
static_assert(std::is_same_v<decltype(tsubu::position<2>)::value_type, tsubu::vec<2>>);
static_assert(sizeof(decltype(tsubu::velocity<2>)::value_type) == 16 &&
              sizeof(decltype(tsubu::force<2>)::value_type) == 16);
static_assert(!flat::has<decltype(tsubu::position<3>)> && !flat::has<decltype(tsubu::velocity<3>)> &&
              !flat::has<decltype(tsubu::angular_velocity<2>)> && !flat::has<decltype(tsubu::torque<2>)> &&
              !flat::has<decltype(history)>);
template <class Layout>
constexpr bool is_sum_of_fields =
    tsubu::particle_store<flat, Layout>::bytes_per_particle == 8 + 3 * 16 + 2 * 8 &&
    sizeof(typename tsubu::particle_store<flat, Layout>::record) == 8 + 3 * 16 + 2 * 8;
static_assert(is_sum_of_fields<tsubu::soa> && is_sum_of_fields<tsubu::aos> && is_sum_of_fields<tsubu::aosoa<16>>);
// What aos and aosoa lay out; unit/store/test_particle_store.cpp weighs the memory of all layouts.
template <std::size_t N>
using flat_block = tsubu::detail::record<N, std::int64_t, tsubu::vec<2>, tsubu::vec<2>, tsubu::vec<2>, double, double>;
static_assert(flat_block<1>::size == 72 && flat_block<16>::size == 16 * std::size_t{72});

// What a program would write by hand.
struct disc {
    std::int64_t t;
    double x[2], v[2], f[2], r, m;
};
static_assert(sizeof(tsubu::particle_store<flat>::record) == sizeof(disc) && flat_block<1>::size == sizeof(disc));

// A list takes 16 bytes, a value that only some particles have 4.
static_assert(tsubu::particle_store<tsubu::fields<history>>::bytes_per_particle == 16);
static_assert(tsubu::particle_store<tsubu::fields<shape>>::bytes_per_particle == 4);

// Sets of fields.
using also = tsubu::fields<tsubu::mass, tsubu::torque<2>, tsubu::id>;
static_assert(std::is_same_v<tsubu::union_of<also, tsubu::fields<tsubu::id, tsubu::radius>>,
                             tsubu::fields<tsubu::mass, tsubu::torque<2>, tsubu::id, tsubu::radius>>);
static_assert(std::is_same_v<tsubu::intersection_of<flat, also>, tsubu::fields<tsubu::id, tsubu::mass>>);
static_assert(std::is_same_v<tsubu::difference_of<also, flat>, tsubu::fields<tsubu::torque<2>>>);
static_assert(std::is_same_v<
              tsubu::fields_on_creation<flat>,
              tsubu::fields<tsubu::id, tsubu::position<2>, tsubu::velocity<2>, tsubu::radius, tsubu::mass>>);
static_assert(std::is_same_v<tsubu::fields_every_step<flat>, tsubu::fields<tsubu::position<2>, tsubu::velocity<2>>>);

// What algorithms ask of iterators and columns.
static_assert(std::random_access_iterator<decltype(tsubu::particle_store<flat>{}[tsubu::radius].begin())>);
static_assert(std::random_access_iterator<decltype(tsubu::particle_store<flat, tsubu::aos>{}[tsubu::radius].begin())>);
static_assert(std::is_nothrow_move_constructible_v<tsubu::particle_store<rich>> &&
              std::is_nothrow_move_assignable_v<tsubu::particle_store<rich>> &&
              std::is_nothrow_default_constructible_v<tsubu::particle_store<rich>>);

static_assert(std::input_iterator<decltype(tsubu::particle_store<rich>{}[history].begin())> &&
              std::input_iterator<decltype(tsubu::particle_store<rich, tsubu::aos>{}[shape].begin())>);

// What std::sort holds of a particle owns its lists: it moves, and is not copied. Without lists it is copied too.
static_assert(std::is_nothrow_move_constructible_v<tsubu::particle_store<rich>::record> &&
              std::is_nothrow_move_assignable_v<tsubu::particle_store<rich>::record> &&
              !std::is_copy_constructible_v<tsubu::particle_store<rich>::record>);
static_assert(std::is_copy_constructible_v<tsubu::particle_store<flat>::record>);

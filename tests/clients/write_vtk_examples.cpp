// SPDX-License-Identifier: MIT
// Writes VTK files into a folder, and beside each a text file of what must be read from it: see check_vtk.py.
#include <tsubu/io/vtk.hpp>

#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace {

inline constexpr tsubu::field<"frozen", bool> frozen{};
inline constexpr tsubu::field<"heat < & \"loss\"", float, "W/m^2"> heat{};
inline constexpr tsubu::field<"contacts", tsubu::list_of<int>> contacts{};
inline constexpr tsubu::field<"tiny", signed char> tiny{};
inline constexpr tsubu::field<"stress", tsubu::vec<6, float>, "Pa"> stress{};

template <std::size_t D, class Layout>
using grains = tsubu::particle_store<
    tsubu::fields<tsubu::id, tsubu::species, tsubu::position<D>, tsubu::velocity<D, float>, frozen, heat, contacts,
                  tiny, stress, tsubu::radius>,
    Layout>;

template <std::size_t D, class Layout>
grains<D, Layout> some_grains(int first, int count) {
    grains<D, Layout> g;
    for (int i = first; i < first + count; ++i) {
        const auto x = static_cast<float>(i);
        const auto at = static_cast<std::size_t>(g.push_back(
            tsubu::id = (std::int64_t{1} << 53) + i, tsubu::species = -i, frozen = i % 2 == 0, heat = 0.1F * x,
            tiny = static_cast<signed char>(-i), stress = {x, 1, -0.0F, 3, 4, 1e-40F},
            tsubu::radius = i == 1 ? std::numeric_limits<double>::max() : 5e-324 * i));
        for (std::size_t k = 0; k < D; ++k) {
            g[tsubu::position<D>][at][k] = 0.1 * i + 1000.0 * static_cast<double>(k);
            g[tsubu::velocity<D, float>][at][k] = x - static_cast<float>(k);
        }
        g[contacts][at].resize(static_cast<std::size_t>(i % 5));
    }
    g.push_back_ghost(tsubu::id = 1);
    return g;
}

/// What VTK must say: "points N", then for each array "array COMPONENTS TYPE UNIT NAME", and a line of numbers for each
/// particle. The type is the name of VTK's class, without vtk and Array.
class expectation {
public:
    explicit expectation(const std::string& path) : file_(path) { file_.precision(17); }

    template <std::size_t D, class... Store>
    void tell(const Store&... g) {
        file_ << "points " << (std::size_t{0} + ... + g.owned_count()) << '\n';
        array(3, "Double", "m", "position", [&](const auto& s, auto i) { three(s[tsubu::position<D>][i]); }, g...);
        array(1, "TypeInt64", "-", "id", [&](const auto& s, auto i) { file_ << s[tsubu::id][i]; }, g...);
        array(1, "TypeInt32", "-", "species", [&](const auto& s, auto i) { file_ << s[tsubu::species][i]; }, g...);
        array(D == 2 ? 3 : D, "Float", "m/s", "velocity", [&](const auto& s, auto i) {
            const auto& v = s[tsubu::velocity<D, float>][i];
            D == 1 ? void(file_ << v[0]) : three(v);
        }, g...);
        array(1, "TypeUInt8", "-", "frozen", [&](const auto& s, auto i) { file_ << (s[frozen][i] ? 1 : 0); }, g...);
        array(1, "Float", "W/m^2", "heat < & \"loss\"", [&](const auto& s, auto i) { file_ << s[heat][i]; }, g...);
        array(1, "TypeUInt32", "-", "contacts", [&](const auto& s, auto i) { file_ << s[contacts][i].size(); }, g...);
        array(1, "TypeInt8", "-", "tiny", [&](const auto& s, auto i) { file_ << int{s[tiny][i]}; }, g...);
        array(6, "Float", "Pa", "stress", [&](const auto& s, auto i) {
            for (const auto x : s[stress][i]) file_ << x << ' ';
        }, g...);
        array(1, "Double", "m", "radius", [&](const auto& s, auto i) { file_ << s[tsubu::radius][i]; }, g...);
    }

private:
    template <class Row, class... Store>
    void array(std::size_t components, const char* type, const char* unit, const char* name, Row row,
               const Store&... g) {
        file_ << "array " << components << ' ' << type << ' ' << unit << ' ' << name << '\n';
        const auto rows = [&](const auto& store) {
            for (std::size_t i = 0; i < store.owned_count(); ++i) {
                row(store, i);
                file_ << '\n';
            }
        };
        (rows(g), ...);
    }
    template <class Vector>
    void three(const Vector& x) {
        for (std::size_t k = 0; k < 3; ++k) file_ << (k < x.size() ? x[k < x.size() ? k : 0] : 0) << ' ';
    }

    std::ofstream file_;
};

template <std::size_t D, class Layout>
void write_examples(const std::string& folder, const std::string& layout) {
    const auto name = layout + std::to_string(D);
    const auto many = some_grains<D, Layout>(0, 10000);
    const auto none = some_grains<D, Layout>(0, 0);
    const auto few = some_grains<D, Layout>(10000, 7);
    const auto write = [&](const auto& g, const std::string& file) {
        tsubu::write_vtp(folder + "/" + file, g, tsubu::position<D>);
        expectation(folder + "/" + file + ".txt").tell<D>(g);
    };
    write(many, name + "_0.vtp");
    write(none, name + "_1.vtp");
    write(few, name + "_2.vtp");
    const std::vector<std::string> pieces{name + "_0.vtp", name + "_1.vtp", name + "_2.vtp"};
    tsubu::write_pvtp(folder + "/" + name + ".pvtp", many, tsubu::position<D>, pieces);
    expectation(folder + "/" + name + ".pvtp.txt").tell<D>(many, none, few);
}

template <class Layout>
void write_dimensions(const std::string& folder, const std::string& layout) {
    write_examples<1, Layout>(folder, layout);
    write_examples<2, Layout>(folder, layout);
    write_examples<3, Layout>(folder, layout);
}

}  // namespace

int main(int count, char** words) {
    if (count != 2) {
        std::cerr << "Usage: " << words[0] << " FOLDER\n";
        return 2;
    }
    try {
        write_dimensions<tsubu::soa>(words[1], "soa");
        write_dimensions<tsubu::aos>(words[1], "aos");
        write_dimensions<tsubu::aosoa<8>>(words[1], "aosoa");
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}

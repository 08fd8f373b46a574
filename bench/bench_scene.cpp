// SPDX-License-Identifier: MIT
/// @file
/// Runs one scene, and shows it: a line of progress, VTK files, energies as CSV, and a picture. Run by bench/scene.

#include "support/picture.hpp"

#include <tsubu/core/error.hpp>
#include <tsubu/dem/measure.hpp>
#include <tsubu/dem/scenes.hpp>
#include <tsubu/io/vtk.hpp>

#if defined(TSUBU_BENCH_WITH_MPI)
#include <tsubu/comm/mpi_environment.hpp>
#include <tsubu/comm/mpi_transport.hpp>
#else
#include <tsubu/comm/self_transport.hpp>
#endif

#include <algorithm>    // std::max, std::min
#include <bit>          // std::bit_cast
#include <charconv>     // std::from_chars
#include <chrono>       // std::chrono::steady_clock
#include <cmath>        // std::cbrt, std::isfinite, std::llround, std::sqrt
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int64_t, std::uint64_t
#include <cstdio>       // std::fprintf, std::printf
#include <cstdlib>      // EXIT_FAILURE, EXIT_SUCCESS
#include <exception>    // std::exception
#include <filesystem>   // std::filesystem::create_directories
#include <fstream>      // std::ofstream
#include <functional>   // std::function
#include <memory>       // std::unique_ptr
#include <optional>     // std::optional
#include <span>         // std::span
#include <stdexcept>    // std::runtime_error
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <vector>       // std::vector

#include <unistd.h>  // isatty

namespace bench {
namespace {

using namespace tsubu::dem;
#if defined(TSUBU_BENCH_WITH_MPI)
using transport_type = tsubu::mpi_transport;
#else
using transport_type = tsubu::self_transport;
#endif

struct request {
    std::string name;
    std::uint64_t steps = 0;            // 0: the scene's own
    double time_step = 0;               // likewise
    std::uint64_t size = 0;             // likewise
    std::optional<std::uint64_t> every;  // steps between two looks; 0: none
    std::string out = ".";
    bool only_times = false;   // prints a line of JSON, and writes nothing
    bool only_checks = false;  // says whether it could run
};

/// What the user has asked for and cannot have. Ends with exit code 2.
class usage_error : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

// ---------------------------------------------------------------------------------------------------------------
// One run

template <class Scene>
class show {
public:
    show(const Scene& scene, const request& asked, std::uint64_t steps, transport_type& on)
        : asked_(asked), steps_(steps), on_(&on), run_(stage(scene, on)) {}

    void go() {
        if (asked_.only_times) {
            time_steps();
            return;
        }
        const auto every = asked_.every ? *asked_.every : (std::max)(std::uint64_t{1}, steps_ / 20);
        std::filesystem::create_directories(asked_.out);
        if (speaks()) {
            table_.open(path(".csv"));
            table_ << "step,time_s,kinetic_J,rotational_J,elastic_J,gravity_J,total_J,contacts_per_particle\n";
        }
        all_ = particle_count(*run_);
        begin_ = std::chrono::steady_clock::now();
        look();
        while (run_->steps_done() < steps_) {
            const auto next = every == 0 ? steps_ : (std::min)(steps_, (run_->steps_done() / every + 1) * every);
            // In small parts, so that the line moves.
            while (run_->steps_done() < next) {
                const auto part = (std::max)(std::uint64_t{1}, 2'000'000 / (std::max)(all_, std::uint64_t{1}));
                run_->steps(static_cast<std::size_t>((std::min)(part, next - run_->steps_done())));
                progress(run_->steps_done() == next);
            }
            look();
        }
        picture();
        if (!speaks()) return;
        tsubu::write_pvd(path(".pvd"), series_);
        table_.close();
        if (!table_) throw std::runtime_error(path(".csv") + ": cannot be written");
        std::fprintf(stderr, "%s: %s, %s, %s\n", asked_.name.c_str(), path(".svg").c_str(), path(".csv").c_str(),
                     path(".pvd").c_str());
    }

private:
    using run_type = run<typename Scene::simulation, transport_type>;
    static constexpr auto D = Scene::simulation::dimension;

    [[nodiscard]] bool speaks() const { return on_->rank() == 0; }
    [[nodiscard]] double time() const { return static_cast<double>(run_->steps_done()) * run_->how().time_step; }
    [[nodiscard]] std::string path(const std::string& ending) const { return asked_.out + "/" + asked_.name + ending; }

    void time_steps() {
        std::vector<double> waited(1, 0);
        on_->reduce(std::span<double>(waited), tsubu::reduction::sum);  // a barrier
        const auto begin = std::chrono::steady_clock::now();
        run_->steps(static_cast<std::size_t>(steps_));
        waited[0] = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        on_->reduce(std::span<double>(waited), tsubu::reduction::greatest);
        const auto count = particle_count(*run_);
        if (speaks())
            std::printf(
                "{\"scene\": \"%s\", \"particles\": %llu, \"ranks\": %zu, \"steps\": %llu, \"seconds\": %.6g}\n",
                asked_.name.c_str(), static_cast<unsigned long long>(count), on_->ranks(),
                static_cast<unsigned long long>(steps_), waited[0]);
    }
    void look() {
        const double kinetic = kinetic_energy(*run_);
        const double spinning = rotational_energy(*run_);
        const double elastic = elastic_energy(*run_);
        const double height = gravity_energy(*run_);
        const double contacts = coordination_number(*run_);
        kinetic_ = kinetic;
        char step[24];
        std::snprintf(step, sizeof step, "_%08llu", static_cast<unsigned long long>(run_->steps_done()));
        const auto own = path(step + (on_->ranks() == 1 ? std::string() : "_" + std::to_string(on_->rank())) + ".vtp");
        constexpr auto x = run_type::simulation_type::quantities_type::position;
        tsubu::write_vtp(own, run_->particles(), x);
        if (!speaks()) return;
        std::string shown = asked_.name + step + ".vtp";
        if (on_->ranks() != 1) {
            std::vector<std::string> pieces;
            for (std::size_t r = 0; r < on_->ranks(); ++r)
                pieces.push_back(asked_.name + step + "_" + std::to_string(r) + ".vtp");
            shown = asked_.name + step + ".pvtp";
            tsubu::write_pvtp(asked_.out + "/" + shown, run_->particles(), x, pieces);
        }
        series_.push_back({time(), shown});
        char row[256];
        std::snprintf(row, sizeof row, "%llu,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.6g\n",
                      static_cast<unsigned long long>(run_->steps_done()), time(), kinetic, spinning, elastic, height,
                      kinetic + spinning + elastic + height, contacts);
        table_ << row;
    }
    void progress(bool is_due) {
        static const bool is_terminal = isatty(2) != 0;
        if (!speaks() || (!is_terminal && !is_due)) return;
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
        const double share = static_cast<double>(run_->steps_done()) / static_cast<double>(steps_);
        std::fprintf(
            stderr,
            "%s%s: %3.0f %%, step %llu of %llu, t = %.4g s, kinetic %.4g J, %.3g Mparticle-steps/s, %.0f s left%s",
            is_terminal ? "\r" : "", asked_.name.c_str(), 100 * share,
            static_cast<unsigned long long>(run_->steps_done()), static_cast<unsigned long long>(steps_), time(),
            kinetic_, 1e-6 * static_cast<double>(run_->steps_done() * all_) / seconds, seconds * (1 - share) / share,
            is_terminal && run_->steps_done() < steps_ ? "\033[K" : "\n");
    }
    /// All particles come to rank 0.
    void picture() {
        std::vector<std::uint64_t> mine;
        const auto& g = run_->particles();
        for (std::size_t i = 0; i < g.owned_count(); ++i) {
            const auto at = static_cast<tsubu::index_t>(i);
            const auto x = run_->position(at);
            double square = 0;
            for (const auto v : g[run_type::simulation_type::quantities_type::velocity][i])
                square += static_cast<double>(v) * static_cast<double>(v);
            for (std::size_t k = 0; k < 3; ++k) mine.push_back(std::bit_cast<std::uint64_t>(k < D ? x[k] : 0.0));
            mine.push_back(std::bit_cast<std::uint64_t>(run_->radius(at)));
            mine.push_back(std::bit_cast<std::uint64_t>(std::sqrt(square)));
        }
        const auto came = on_->gather(std::span<const std::uint64_t>(mine));
        if (!speaks()) return;
        std::vector<drawn_sphere> spheres;
        for (const auto& parcel : came)
            for (std::size_t k = 0; k + 5 <= parcel.words.size(); k += 5) {
                const auto number = [&](std::size_t n) { return std::bit_cast<double>(parcel.words[k + n]); };
                spheres.push_back({{number(0), number(1), number(2)}, number(3), number(4)});
            }
        char title[128];
        std::snprintf(title, sizeof title, "%s: %zu %s%s, t = %.4g s", asked_.name.c_str(), spheres.size(),
                      D == 2 && !run_type::simulation_type::has_walls ? "disk" : "sphere",
                      spheres.size() == 1 ? "" : "s", time());
        sphere_picture(title, D == 3).write(path(".svg"), spheres, outlines(spheres));
    }
    /// Walls, as far as there are spheres; the edges of a box of three dimensions.
    [[nodiscard]] std::vector<drawn_line> outlines(const std::vector<drawn_sphere>& spheres) const {
        std::vector<drawn_line> lines;
        std::array<double, 3> lo{1e300, 1e300, 1e300};
        std::array<double, 3> hi{-1e300, -1e300, -1e300};
        for (const auto& one : spheres)
            for (std::size_t k = 0; k < 3; ++k) {
                lo[k] = (std::min)(lo[k], one.x[k] - one.radius);
                hi[k] = (std::max)(hi[k], one.x[k] + one.radius);
            }
        if constexpr (run_type::simulation_type::has_walls) {
            for (const auto& wall : run_->template model<walls>().planes) {
                if constexpr (D == 1) lines.push_back({{wall.point[0], -1, 0}, {wall.point[0], 1, 0}, true});
                if constexpr (D == 2) {
                    // Along the wall, two diameters farther than the spheres.
                    const double reach = (hi[0] - lo[0]) + (hi[1] - lo[1]);
                    const double middle = (lo[0] + hi[0]) / 2 - wall.point[0];
                    const double along = -middle * wall.normal[1];
                    const auto end = [&](double t) {
                        return std::array<double, 3>{wall.point[0] - t * wall.normal[1],
                                                     wall.point[1] + t * wall.normal[0], 0};
                    };
                    lines.push_back({end(along - reach / 2), end(along + reach / 2), true});
                }
            }
        }
        if constexpr (D == 3) {
            if constexpr (run_type::simulation_type::has_walls) lo[2] = 0;
            for (unsigned edge = 0; edge < 12; ++edge) {
                const std::size_t along = edge / 4;
                std::array<double, 3> from = lo;
                if ((edge & 1U) != 0) from[(along + 1) % 3] = hi[(along + 1) % 3];
                if ((edge & 2U) != 0) from[(along + 2) % 3] = hi[(along + 2) % 3];
                auto to = from;
                to[along] = hi[along];
                lines.push_back({from, to, false});
            }
        }
        return lines;
    }

    const request& asked_;
    std::uint64_t steps_;
    transport_type* on_;
    std::unique_ptr<run_type> run_;
    std::ofstream table_;
    std::vector<tsubu::vtk_time> series_;
    std::uint64_t all_ = 0;
    double kinetic_ = 0;
    std::chrono::steady_clock::time_point begin_{};
};

// ---------------------------------------------------------------------------------------------------------------
// The scenes

struct entry {
    std::string name;
    std::string what;
    double time_step;
    std::uint64_t steps;
    std::uint64_t size;  // 0: cannot be chosen
    std::function<void(const request&, transport_type&)> run;  // with all of it filled in
};

std::uint64_t edge_of(std::uint64_t size, std::size_t dimensions, double share = 1) {
    const auto n = static_cast<double>(size) * share;
    const double edge = dimensions == 3 ? std::cbrt(n) : dimensions == 2 ? std::sqrt(n) : n;
    return static_cast<std::uint64_t>((std::max)(std::llround(edge), 1LL));
}

template <class Make>
entry scene(std::string name, std::string what, double time_step, std::uint64_t steps, std::uint64_t size, Make make) {
    return {name, what, time_step, steps, size, [make](const request& asked, transport_type& on) {
                const auto made = make(asked);
                show<std::remove_const_t<decltype(made)>>(made, asked, asked.steps, on).go();
            }};
}

std::vector<entry> all_scenes() {
    constexpr double k = 2e5;
    const hooke_dashpot<linear_history> sticky{{k, 50}, {k * 2 / 7, 0.5, 50}};
    std::vector<entry> all;
    all.push_back(
        scene("pair", "two spheres that collide head on, spring and dashpot", 2e-5, 1000, 0, [](const request& r) {
            return pair_scene<hooke_dashpot<>>{.law = hooke_dashpot<>{{k, 50}}, .time_step = r.time_step, .phase = 300};
        }));
    all.push_back(
        scene("bounce", "a sphere that falls on a floor, again and again", 2e-5, 100000, 0, [](const request& r) {
            return bounce_scene<>{.law = hooke_dashpot<>{{5e4, 10}}, .time_step = r.time_step};
        }));
    all.push_back(scene("chain", "masses on springs between fixed ends, in their first mode", 0.5, 1000, 64,
                        [](const request& r) { return chain_scene<>{.time_step = r.time_step, .masses = r.size}; }));
    all.push_back(scene("crystal", "spheres pressed together in an FCC crystal that ripples", 0.5, 2000, 864,
                        [](const request& r) {
                            return crystal_scene<>{.law = hooke<>{{1}},
                                                   .time_step = r.time_step,
                                                   .cells = edge_of(r.size, 3, 0.25)};
                        }));
    all.push_back(scene("slip", "a sphere that slides on a floor until it rolls", 1e-5, 20000, 0, [](const request& r) {
        return floor_scene<>{.law = hooke_dashpot<coulomb>{{k, 50}, {0.3, 1e4}}, .time_step = r.time_step};
    }));
    all.push_back(scene("incline", "a sphere on a slope that friction and rolling resistance hold", 1e-5, 50000, 0,
                        [sticky](const request& r) {
                            using law = hooke_dashpot<linear_history, rolling_resistance>;
                            const law rough{{k, 50}, sticky.tangential(), {.mu_r = 0.4, .eta_r = 0.3}};
                            return floor_scene<law>{.law = rough,
                                                    .time_step = r.time_step,
                                                    .speed = 0,
                                                    .slope = 0.1};
                        }));
    all.push_back(scene("oblique", "a sphere that hits a floor at 45 degrees", 1e-5, 2000, 0, [](const request& r) {
        return oblique_scene<>{.law = hooke<linear_history>{{k}, {k * 2 / 7, 0.5}},
                               .time_step = r.time_step,
                               .phase = 50};
    }));
    all.push_back(scene("gas", "an elastic gas, periodic", 2e-4, 20000, 10648, [](const request& r) {
        return gas_scene<>{.law = hooke<>{{k}}, .time_step = r.time_step, .per_edge = edge_of(r.size, 3)};
    }));
    all.push_back(scene("cooling", "a gas that cools, restitution .9", 2e-4, 50000, 10648, [](const request& r) {
        return gas_scene<hooke_dashpot<>>{
            .law = hooke_dashpot<>{{k, 42.40}}, .time_step = r.time_step, .per_edge = edge_of(r.size, 3)};
    }));
    all.push_back(scene("disks", "a gas of disks in two dimensions", 2e-4, 20000, 4096, [](const request& r) {
        return disks_scene<>{
            .law = hooke<>{{k}}, .time_step = r.time_step, .per_edge = edge_of(r.size, 2), .fraction = 0.15};
    }));
    all.push_back(scene("settle", "spheres that fall on a floor and settle", 2e-4, 60000, 10000, [](const request& r) {
        // As wide as it is deep, and as high as the standard one is to its width.
        const auto edge = r.size == 100000 ? 50 : edge_of(r.size, 3, 0.8);
        const auto high = (std::max)(std::uint64_t{1}, (r.size + edge * edge / 2) / (edge * edge));
        return settle_scene<>{.time_step = r.time_step, .cells = {edge, edge, high}};
    }));
    all.push_back(scene("far", "the elastic gas a million metres away, with ids near 9e12", 2e-4, 20000, 10648,
                        [](const request& r) {
                            return gas_scene<>{.law = hooke<>{{k}},
                                               .time_step = r.time_step,
                                               .per_edge = edge_of(r.size, 3),
                                               .origin = 1e6,
                                               .first_id = 9'000'000'000'000};
                        }));
    return all;
}

// ---------------------------------------------------------------------------------------------------------------
// The command line

template <class Number>
Number number_of_word(const std::string& option, const std::string& word, Number least, const char* what) {
    Number value{};
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    bool is_good = fault == std::errc{} && end == word.data() + word.size() && !word.empty();
    if constexpr (std::is_floating_point_v<Number>) is_good = is_good && std::isfinite(value) && value > least;
    if constexpr (!std::is_floating_point_v<Number>) is_good = is_good && value >= least;
    if (!is_good) throw usage_error(option + " " + word + ": give " + what);
    return value;
}

void list(const std::vector<entry>& scenes) {
    std::printf("%-9s %10s %9s %8s  %s\n", "name", "--dt", "--steps", "--size", "what");
    for (const auto& one : scenes)
        std::printf("%-9s %10g %9llu %8s  %s\n", one.name.c_str(), one.time_step,
                    static_cast<unsigned long long>(one.steps), one.size == 0 ? "-" : std::to_string(one.size).c_str(),
                    one.what.c_str());
}

/// What is to be done; no value if only the list was asked for.
std::optional<request> parse(int argc, char** argv) {
    request asked;
    for (int n = 1; n < argc; ++n) {
        const std::string word = argv[n];
        const auto value = [&]() -> std::string {
            if (n + 1 >= argc) throw usage_error(word + " needs a value");
            return argv[++n];
        };
        if (word == "--list") return std::nullopt;
        if (word == "--timing")
            asked.only_times = true;
        else if (word == "--check")
            asked.only_checks = true;
        else if (word == "--steps")
            asked.steps = number_of_word<std::uint64_t>(word, value(), 1, "a whole number of steps, at least 1");
        else if (word == "--dt")
            asked.time_step = number_of_word<double>(word, value(), 0, "a time step above 0, in seconds");
        else if (word == "--size")
            asked.size = number_of_word<std::uint64_t>(word, value(), 1, "a whole number of particles, at least 1");
        else if (word == "--every")
            asked.every =
                number_of_word<std::uint64_t>(word, value(), 0, "a whole number of steps; 0 for none between");
        else if (word == "--out")
            asked.out = value();
        else if (word.starts_with("-"))
            throw usage_error("unknown option: " + word + "; see bench/scene --help");
        else if (asked.name.empty())
            asked.name = word;
        else
            throw usage_error("one scene at a time: " + asked.name + ", or " + word);
    }
    if (asked.name.empty()) throw usage_error("which scene? bench/scene --list names them");
    return asked;
}

int run(int argc, char** argv, transport_type& on) {
    const auto scenes = all_scenes();
    try {
        auto asked = parse(argc, argv);
        if (!asked) {
            if (on.rank() == 0) list(scenes);
            return EXIT_SUCCESS;
        }
        for (const auto& one : scenes) {
            if (one.name != asked->name) continue;
            if (asked->size != 0 && one.size == 0)
                throw usage_error("--size: the scene " + one.name + " has always the same spheres");
            if (asked->size == 0) asked->size = one.size;
            if (asked->size > 50'000'000) throw usage_error("--size: at most 50000000");
            if (asked->steps == 0) asked->steps = one.steps;
            if (asked->time_step == 0) asked->time_step = one.time_step;
            if (!asked->only_checks) one.run(*asked, on);
            return EXIT_SUCCESS;
        }
        throw usage_error("no such scene: " + asked->name + "; bench/scene --list names them");
    } catch (const usage_error& fault) {
        if (on.rank() == 0) std::fprintf(stderr, "bench/scene: %s\n", fault.what());
        return 2;
    } catch (const tsubu::input_error& fault) {  // on all ranks
        if (on.rank() == 0) std::fprintf(stderr, "\nbench/scene: %s\n", fault.what());
        return EXIT_FAILURE;
    } catch (const std::exception& fault) {
        std::fprintf(stderr, "\nbench/scene: %s\n", fault.what());
        return EXIT_FAILURE;
    }
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
#if defined(TSUBU_BENCH_WITH_MPI)
    const tsubu::mpi_environment mpi(argc, argv);
    tsubu::mpi_transport on(MPI_COMM_WORLD);
    const int result = bench::run(argc, argv, on);
    // Errors of a file come on one rank, and the others would wait.
    if (result == EXIT_FAILURE && on.ranks() > 1) MPI_Abort(MPI_COMM_WORLD, result);
    return result;
#else
    tsubu::self_transport on;
    return bench::run(argc, argv, on);
#endif
}

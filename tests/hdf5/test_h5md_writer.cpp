// SPDX-License-Identifier: MIT
#include <tsubu/io/h5md_writer.hpp>

#include "hdf5/h5md_examples.hpp"
#include "support/catch.hpp"
#include "unit/io/scratch_folder.hpp"
#include "unit/thrown.hpp"

#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/triclinic_box.hpp>
#include <tsubu/io/h5md_reader.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <csignal>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using tsubu::file_error;
using tsubu::input_error;

namespace {

using set = tsubu::fields<tsubu::id, tsubu::position<3>>;
using without_ids = tsubu::fields<tsubu::position<3>>;
using store = tsubu::particle_store<set>;
const tsubu::domain<3> box({0, 0, 0}, {1, 1, 1});

store some(int count) {
    store g;
    for (int i = 0; i < count; ++i) g.push_back(tsubu::id = i + 10, tsubu::position<3> = {0.25 * i, 0.5, -1.0 * i});
    return g;
}

}  // namespace

TEST_CASE("a file that exists is refused, or replaced if asked", "[io][h5md]") {
    const scratch_folder folder;
    const auto path = folder / "run.h5";
    write_bytes(path, "precious");
    const auto text = thrown<file_error>([&] { tsubu::h5md_writer<set>(path, box); });
    CHECK(says(text, path + ": it exists; take another name, or set h5md_options.replace"));
    CHECK(bytes_of(path) == "precious");
    tsubu::h5md_writer<set>(path, box, {.replace = true}).append(1, 0, some(2), box);
    CHECK(tsubu::h5md_reader(path).frames() == 1);
}
TEST_CASE("a file that cannot be made is told, and nothing is left", "[io][h5md]") {
    const scratch_folder folder;
    CHECK(says(thrown<file_error>([&] { tsubu::h5md_writer<set>(folder / "none/run.h5", box); }),
               "make the folder first"));
    CHECK(says(thrown<file_error>([&] { tsubu::h5md_writer<set>(folder.path(), box, {.replace = true}); }),
               "there is a folder with this name"));
    CHECK(says(thrown<input_error>([&] { tsubu::h5md_writer<set>(folder / "run.h5", box, {.group = "a/b"}); }),
               "a group of the name 'a/b'"));
    CHECK(folder.files() == 0);
}
TEST_CASE("a frame that breaks the contract is refused, and the file goes on", "[io][h5md]") {
    const scratch_folder folder;
    const auto path = folder / "run.h5";
    const auto g = some(3);
    const auto nan = std::numeric_limits<double>::quiet_NaN();
    tsubu::h5md_writer<set> file(path, box);
    file.append(10, 1, g, box);
    const auto refused = [&](std::int64_t step, double time, const auto& with) {
        return thrown<input_error>([&] { file.append(step, time, g, with); });
    };
    CHECK(says(refused(10, 2, box), path + ": step 10 after step 10; append each step once"));
    CHECK(says(refused(9, 2, box), "step 9 after step 10"));
    CHECK(says(refused(11, nan, box), "the time nan of step 11"));
    CHECK(says(refused(11, 0.5, box), "the time 0.5 after 1"));
    const tsubu::domain<3> periodic({0, 0, 0}, {1, 1, 1}, {.periodic = {true, false, false}});
    CHECK(says(refused(11, 2, periodic), "periodic axes than the first"));
    const tsubu::triclinic_box<3> tilted({0, 0, 0}, {1, 1, 1}, {0.5, 0, 0}, {});
    CHECK(says(refused(11, 2, tilted), "angles or periodic axes than the first"));
    auto bad = g;
    bad[tsubu::id][1] = -1;
    CHECK(says(thrown<input_error>([&] { file.append(11, 2, bad, box); }), "particle 1 has the id -1"));
    CHECK(file.frames() == 1);
    file.append(11, 1, g, box);
    file.close();
    file.close();
    CHECK(says(thrown<input_error>([&] { file.append(12, 2, g, box); }), "the file is closed"));
    const tsubu::h5md_reader reader(path);
    REQUIRE(reader.frames() == 2);
    CHECK(reader.step(1) == 11);
    CHECK(reader.time(1) == 1);
}
TEST_CASE("the number of particles changes only where ids tell", "[io][h5md]") {
    const scratch_folder folder;
    tsubu::h5md_writer<without_ids> file(folder / "run.h5", box);
    file.append(1, 0, some(3), box);
    const auto text = thrown<input_error>([&] { file.append(2, 0, some(4), box); });
    CHECK(says(text, "4 particles after 3; add tsubu::id to the fields"));
    file.append(2, 0, some(3), box);
    CHECK(file.frames() == 2);
}
TEST_CASE("only owned particles are written", "[io][h5md]") {
    const scratch_folder folder;
    auto g = some(3);
    g.push_back_ghost(tsubu::id = 99);
    tsubu::h5md_writer<set>(folder / "run.h5", box).append(1, 0, g, box);
    store again;
    tsubu::h5md_reader(folder / "run.h5").read(0, again, set{});
    CHECK(same_particles(again, some(3)));
}
TEST_CASE("a writer that is moved goes on", "[io][h5md]") {
    const scratch_folder folder;
    tsubu::h5md_writer<set> first(folder / "run.h5", box);
    first.append(1, 0, some(2), box);
    auto second = std::move(first);
    second.append(2, 0, some(5), box);
    CHECK(second.frames() == 2);
    CHECK(second.path() == folder / "run.h5");
}
TEST_CASE("the file can be read while it is written, by the same program", "[io][h5md]") {
    const scratch_folder folder;
    tsubu::h5md_writer<set> file(folder / "run.h5", box);
    CHECK(tsubu::h5md_reader(folder / "run.h5").frames() == 0);
    file.append(1, 0, some(2), box);
    CHECK(tsubu::h5md_reader(folder / "run.h5").frames() == 1);
    file.append(2, 0, some(2), box);
    CHECK(tsubu::h5md_reader(folder / "run.h5").frames() == 2);
}
TEST_CASE("what HDF5 prints is as before after a call that failed", "[io][h5md]") {
    H5E_auto2_t before = nullptr;
    H5E_auto2_t after = nullptr;
    void* with = nullptr;
    H5Eget_auto2(H5E_DEFAULT, &before, &with);
    CHECK_THROWS_AS(tsubu::h5md_writer<set>("/nowhere/run.h5", box), file_error);
    H5Eget_auto2(H5E_DEFAULT, &after, &with);
    CHECK(before == after);
    CHECK(before != nullptr);
}
TEST_CASE("nothing stays open, whatever happens", "[io][h5md]") {
    const scratch_folder folder;
    const auto path = folder / "run.h5";
    {
        tsubu::h5md_writer<set> file(path, box);
        file.append(1, 0, some(20), box);
        file.append(2, 0, some(30), box);
        CHECK_THROWS_AS(file.append(2, 0, some(30), box), input_error);
        const tsubu::h5md_reader reader(path);
        store again;
        reader.read(1, again, set{});
        static_cast<void>(reader.box(0));
        CHECK_THROWS_AS(reader.read(5, again, set{}), input_error);
    }
    CHECK(H5Fget_obj_count(static_cast<hid_t>(H5F_OBJ_ALL), H5F_OBJ_ALL) == 0);
}
TEST_CASE("a program that is killed leaves all frames that it has appended", "[io][h5md]") {
    const scratch_folder folder;
    const auto path = folder / "run.h5";
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    const auto child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        tsubu::h5md_writer<set> file(path, box);
        for (int k = 0; k < 20; ++k) file.append(k, k, some(50 + k), box);
        const char done = 1;
        if (::write(ends[1], &done, 1) != 1) ::_exit(1);
        for (;;) ::pause();
    }
    char done = 0;
    CHECK(::read(ends[0], &done, 1) == 1);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ::close(ends[0]);
    ::close(ends[1]);
    const tsubu::h5md_reader reader(path);
    REQUIRE(reader.frames() == 20);
    for (int k = 0; k < 20; ++k) {
        store again;
        reader.read(static_cast<std::size_t>(k), again, set{});
        CHECK(same_particles(again, some(50 + k)));
    }
}
TEST_CASE("a disk that is full costs the frame that does not fit, and nothing else", "[io][h5md]") {
    const scratch_folder folder;
    const auto path = folder / "run.h5";
    const auto before = std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit{};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &limit) == 0);
    const auto limit_to = [&](rlim_t bytes) {
        const rlimit lower{bytes, limit.rlim_max};
        return ::setrlimit(RLIMIT_FSIZE, &lower) == 0;
    };
    {
        tsubu::h5md_writer<set> file(path, box);
        REQUIRE(limit_to(800'000));
        std::string text = "nothing was thrown";
        int k = 0;
        try {
            for (; k < 1000; ++k) file.append(k, k, some(500), box);
        } catch (const file_error& error) {
            text = error.what();
        }
        CHECK(says(text, "cannot write " + path + ": File too large; raise the limit"));
        CHECK(k > 10);
        CHECK(file.frames() == static_cast<std::size_t>(k));
        CHECK_THROWS_AS(file.append(k, k, some(500), box), file_error);
        CHECK(tsubu::h5md_reader(path).frames() == static_cast<std::size_t>(k));
        REQUIRE(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
        file.append(k, k, some(600), box);
        CHECK(file.frames() == static_cast<std::size_t>(k) + 1);
        // With no room for a header either, not even an empty file is left.
        REQUIRE(limit_to(10'000));
        CHECK_THROWS_AS(tsubu::h5md_writer<set>(folder / "other.h5", box), file_error);
        REQUIRE(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
        CHECK(folder.files() == 1);
    }
    std::signal(SIGXFSZ, before);
    const tsubu::h5md_reader reader(path);
    store again;
    reader.read(reader.frames() - 1, again, set{});
    CHECK(same_particles(again, some(600)));
}

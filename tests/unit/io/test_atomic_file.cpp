// SPDX-License-Identifier: MIT
#include <tsubu/io/atomic_file.hpp>

#include "support/catch.hpp"
#include "unit/io/scratch_folder.hpp"
#include "unit/thrown.hpp"

#include <tsubu/io/byte_source.hpp>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

using tsubu::atomic_file;
using tsubu::file_error;

namespace {

/// While it lives, files may not become longer.
class longest_file {
public:
    explicit longest_file(rlim_t bytes) : old_signal_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &old_);
        auto limit = old_;
        limit.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    longest_file(const longest_file&) = delete;
    ~longest_file() {
        ::setrlimit(RLIMIT_FSIZE, &old_);
        std::signal(SIGXFSZ, old_signal_);
    }

private:
    void (*old_signal_)(int);
    rlimit old_{};
};

}  // namespace

TEST_CASE("a file has its name when it is whole, and not before", "[io][atomic_file]") {
    const scratch_folder folder;
    const auto path = folder / "run.vtp";
    write_bytes(path, "old");
    {
        atomic_file file(path);
        file.append("new ");
        file.append("content");
        CHECK(file.appended() == 11);
        CHECK(bytes_of(path) == "old");
        CHECK(folder.files() == 2);
        CHECK(bytes_of(file.temporary_path()) == "new content");
        file.commit();
        CHECK(bytes_of(path) == "new content");
    }
    CHECK(bytes_of(path) == "new content");
    CHECK(folder.files() == 1);
}

TEST_CASE("what is not whole leaves nothing behind", "[io][atomic_file]") {
    const scratch_folder folder;
    const auto path = folder / "run.vtp";
    for (const bool old : {false, true}) {
        if (old) write_bytes(path, "old");
        { atomic_file file(path); }
        try {
            atomic_file file(path);
            file.append("half of it");
            throw std::runtime_error("in between");
        } catch (const std::runtime_error&) {
        }
        CHECK(folder.files() == (old ? 1 : 0));
    }
    CHECK(bytes_of(path) == "old");
}

TEST_CASE("two at once do not meet", "[io][atomic_file]") {
    const scratch_folder folder;
    atomic_file first(folder / "a");
    atomic_file second(folder / "a");
    CHECK(first.temporary_path() != second.temporary_path());
    // As if a process of the same number, on another machine, were writing to the same disk.
    const auto used = second.temporary_path();
    const auto number = std::stoi(used.substr(used.rfind('-') + 1));
    const auto prefix = (folder / "b.") + std::to_string(::getpid()) + "-";
    for (int k = 1; k <= 500; ++k) write_bytes(prefix + std::to_string(number + k) + ".partial", "");
    atomic_file third(folder / "b");
    third.append("mine");
    third.commit();
    first.append("1");
    second.append("2");
    second.commit();
    first.commit();
    CHECK(bytes_of(folder / "a") == "1");
    CHECK(bytes_of(folder / "b") == "mine");
    CHECK(folder.files() == 502);
}

TEST_CASE("others write into it at their places", "[io][atomic_file]") {
    const scratch_folder folder;
    atomic_file file(folder / "a");
    tsubu::file_writer other(file.temporary_path());
    other.write_at(3, std::as_bytes(std::span("def", 3)));
    file.writer().write_at(0, std::as_bytes(std::span("abc", 3)));
    other.close();
    CHECK(file.writer().size() == 6);
    file.commit();
    CHECK(bytes_of(folder / "a") == "abcdef");
}

TEST_CASE("the system's refusals are told with name, reason and remedy", "[io][atomic_file][input]") {
    const scratch_folder folder;
    const auto no_folder = thrown<file_error>([&] { atomic_file(folder / "none/run.vtp"); });
    INFO(no_folder);
    CHECK(says(no_folder, "cannot make " + (folder / "none/run.vtp") + ": No such file or directory"));
    CHECK(says(no_folder, "make the folder first"));
    const auto no_file = thrown<file_error>([&] { tsubu::file_source(folder / "none/run.vtp"); });
    CHECK(says(no_file, "cannot open " + (folder / "none/run.vtp") + ": No such file or directory"));
    CHECK(says(no_file, "check the name and the folder"));

    write_bytes(folder / "plain", "");
    CHECK(says(thrown<file_error>([&] { atomic_file(folder / "plain/run.vtp"); }), "Not a directory"));

    std::filesystem::create_directory(folder / "taken");
    const auto taken = thrown<file_error>([&] { atomic_file(folder / "taken").commit(); });
    INFO(taken);
    CHECK(says(taken, "cannot write " + (folder / "taken")));
    CHECK(says(taken, "there is a folder with this name"));
    CHECK(folder.files() == 2);

    // The name is given away while the file is written.
    const auto late = thrown<file_error>([&] {
        atomic_file file(folder / "late");
        std::filesystem::create_directory(folder / "late");
        file.commit();
    });
    INFO(late);
    CHECK(says(late, "cannot give its name to " + (folder / "late")));
    CHECK(says(late, "there is a folder with this name"));
    CHECK(folder.files() == 3);

    try {
        atomic_file(folder / std::string(300, 'x'));
        FAIL("a name of 300 letters was taken");
    } catch (const file_error& error) {
        CHECK(error.code() == ENAMETOOLONG);
        CHECK(says(error.what(), "give a shorter name"));
    }
}

TEST_CASE("each refusal of the system has its remedy", "[io][atomic_file]") {
    using tsubu::detail::file_remedy;
    for (const int code : {EACCES, EPERM, EROFS}) CHECK(says(file_remedy(code, false), "allowed to use"));
    for (const int code : {EMFILE, ENFILE}) CHECK(says(file_remedy(code, false), "ulimit -n"));
    for (const int code : {ENOSPC, EDQUOT}) CHECK(says(file_remedy(code, false), "free some space"));
    CHECK(says(file_remedy(EIO, false), "check the disk"));
}

TEST_CASE("a file that becomes shorter while it is read is refused", "[io][byte_source][input]") {
    const scratch_folder folder;
    write_bytes(folder / "a", "0123456789");
    const tsubu::file_source file(folder / "a");
    std::array<std::byte, 8> bytes{};
    file.read(2, bytes);
    CHECK(bytes[7] == std::byte{'9'});
    REQUIRE(::truncate((folder / "a").c_str(), 5) == 0);
    const auto message = thrown<tsubu::input_error>([&] { file.read(2, bytes); });
    INFO(message);
    CHECK(says(message, (folder / "a") + " ends at byte 5; it became shorter while it was read"));
}
TEST_CASE("memory is not read beyond its end", "[io][byte_source]") {
    const tsubu::memory_source source(std::string_view("0123456789"), "text");
    std::array<std::byte, 4> bytes{};
    source.read(6, bytes);
    CHECK(bytes[3] == std::byte{'9'});
    CHECK(says(thrown<tsubu::input_error>([&] { source.read(7, bytes); }), "text has 10 bytes; asked for 4 from 7 on"));
    CHECK(says(thrown<tsubu::input_error>([&] { source.read(~std::uint64_t{0}, bytes); }), "asked for 4 from"));
}
TEST_CASE("files that are moved are open once", "[io][byte_source][atomic_file]") {
    const scratch_folder folder;
    write_bytes(folder / "a", "a");
    write_bytes(folder / "b", "of b");
    tsubu::file_source first(folder / "a");
    first = tsubu::file_source(folder / "b");
    CHECK(first.name() == folder / "b");
    CHECK(first.size() == 4);
    const auto second = std::move(first);
    std::array<std::byte, 4> bytes{};
    second.read(0, bytes);
    CHECK(bytes[3] == std::byte{'b'});

    tsubu::file_writer out(folder / "a");
    out = tsubu::file_writer(folder / "b");
    auto last = std::move(out);
    last.write_at(0, std::as_bytes(std::span("in", 2)));
    last.close();
    CHECK(bytes_of(folder / "a") == "a");
    CHECK(bytes_of(folder / "b") == "in b");
}

TEST_CASE("a full disk is told, and nothing is left on it", "[io][atomic_file][input]") {
    const scratch_folder folder;
    const std::string half(5000, 'x');
    {
        const longest_file limit(8000);
        const auto message = thrown<file_error>([&] {
            atomic_file file(folder / "run.vtp");
            file.append(half);
            file.append(half);
            file.commit();
        });
        INFO(message);
        CHECK(says(message, "run.vtp: File too large; raise the limit"));
    }
    CHECK(folder.files() == 0);
    if (::access("/dev/full", W_OK) == 0) {
        const auto message = thrown<file_error>([&] {
            tsubu::file_writer file("/dev/full");
            file.write_at(0, std::as_bytes(std::span(half)));
        });
        INFO(message);
        CHECK(says(message, "cannot write /dev/full: No space left on device; free some space"));
    }
}

TEST_CASE("a pipe is neither replaced by a file nor waited for", "[io][atomic_file]") {
    const scratch_folder folder;
    const auto pipe = folder / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    CHECK(says(thrown<tsubu::input_error>([&] { tsubu::atomic_file file(pipe); }), "is a pipe or a device"));
    CHECK(says(thrown<tsubu::input_error>([&] { tsubu::file_source file(pipe); }), "is not a file"));
    CHECK(folder.files() == 1);
}

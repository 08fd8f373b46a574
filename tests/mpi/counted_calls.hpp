// SPDX-License-Identifier: MIT
/// @file
/// Counts of the MPI calls that are made in between, by the profiling interface. Included by one file of a program.
#pragma once

#include <tsubu/comm/detail/include_mpi.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace counted {

struct message {
    int to;
    std::size_t bytes;
};
/// Since clear(): how often each function was called, and what was sent point to point.
struct calls {
    std::map<std::string, int> count;
    std::vector<message> sent;
    bool has_used_world = false;

    void clear() {
        count.clear();
        sent.clear();
        has_used_world = false;
    }
    [[nodiscard]] int of(const std::string& name) const {
        const auto at = count.find(name);
        return at == count.end() ? 0 : at->second;
    }
    /// Of all functions but these.
    [[nodiscard]] int but(std::initializer_list<const char*> names) const {
        int all = 0;
        for (const auto& [name, times] : count) all += times;
        for (const auto* name : names) all -= of(name);
        return all;
    }
    [[nodiscard]] std::string text() const {
        std::string all;
        for (const auto& [name, times] : count) all += name + " " + std::to_string(times) + ", ";
        return all;
    }
};
inline calls seen;
inline std::map<MPI_Request, message> persistent_sends;

inline void call(const char* name, MPI_Comm on = MPI_COMM_NULL) {
    ++seen.count[name];
    if (on == MPI_COMM_WORLD) seen.has_used_world = true;
}
[[nodiscard]] inline std::size_t bytes_of(int count, MPI_Datatype type) {
    int size = 0;
    PMPI_Type_size(type, &size);
    return static_cast<std::size_t>(count) * static_cast<std::size_t>(size);
}
inline void start(MPI_Request request) {
    const auto at = persistent_sends.find(request);
    if (at != persistent_sends.end()) seen.sent.push_back(at->second);
}

}  // namespace counted

#define COUNTED(name, on, parameters, arguments) \
    int MPI_##name parameters {                             \
        counted::call(#name, on);                           \
        return PMPI_##name arguments;                       \
    }
#define COUNTED_SEND(name)                                                                                 \
    int MPI_##name(const void* x, int n, MPI_Datatype t, int to, int tag, MPI_Comm c, MPI_Request* r) {               \
        counted::call(#name, c);                                                                                      \
        counted::seen.sent.push_back({to, counted::bytes_of(n, t)});                                                  \
        return PMPI_##name(x, n, t, to, tag, c, r);                                                                   \
    }
#define COUNTED_BLOCKING_SEND(name)                                                   \
    int MPI_##name(const void* x, int n, MPI_Datatype t, int to, int tag, MPI_Comm c) {          \
        counted::call(#name, c);                                                                 \
        counted::seen.sent.push_back({to, counted::bytes_of(n, t)});                             \
        return PMPI_##name(x, n, t, to, tag, c);                                                 \
    }

extern "C" {

COUNTED_SEND(Isend)
COUNTED_SEND(Issend)
COUNTED_SEND(Irsend)
COUNTED_SEND(Ibsend)
COUNTED_BLOCKING_SEND(Send)
COUNTED_BLOCKING_SEND(Ssend)
COUNTED_BLOCKING_SEND(Rsend)
COUNTED_BLOCKING_SEND(Bsend)
int MPI_Send_init(const void* x, int n, MPI_Datatype t, int to, int tag, MPI_Comm c, MPI_Request* r) {
    counted::call("Send_init", c);
    const int code = PMPI_Send_init(x, n, t, to, tag, c, r);
    counted::persistent_sends[*r] = {to, counted::bytes_of(n, t)};
    return code;
}
int MPI_Startall(int n, MPI_Request* r) {
    counted::call("Startall");
    for (int k = 0; k < n; ++k) counted::start(r[k]);
    return PMPI_Startall(n, r);
}
int MPI_Start(MPI_Request* r) {
    counted::call("Start");
    counted::start(*r);
    return PMPI_Start(r);
}
int MPI_Request_free(MPI_Request* r) {
    counted::call("Request_free");
    counted::persistent_sends.erase(*r);
    return PMPI_Request_free(r);
}
COUNTED(Recv_init, c, (void* x, int n, MPI_Datatype t, int from, int tag, MPI_Comm c, MPI_Request* r),
                   (x, n, t, from, tag, c, r))
COUNTED(Recv, c, (void* x, int n, MPI_Datatype t, int from, int tag, MPI_Comm c, MPI_Status* s),
                   (x, n, t, from, tag, c, s))
COUNTED(Irecv, c, (void* x, int n, MPI_Datatype t, int from, int tag, MPI_Comm c, MPI_Request* r),
                   (x, n, t, from, tag, c, r))
COUNTED(Mrecv, MPI_COMM_NULL, (void* x, int n, MPI_Datatype t, MPI_Message* m, MPI_Status* s), (x, n, t, m, s))
COUNTED(Probe, c, (int from, int tag, MPI_Comm c, MPI_Status* s), (from, tag, c, s))
COUNTED(Iprobe, c, (int from, int tag, MPI_Comm c, int* found, MPI_Status* s), (from, tag, c, found, s))
COUNTED(Improbe, c, (int from, int tag, MPI_Comm c, int* found, MPI_Message* m, MPI_Status* s),
                   (from, tag, c, found, m, s))
COUNTED(Mprobe, c, (int from, int tag, MPI_Comm c, MPI_Message* m, MPI_Status* s), (from, tag, c, m, s))
COUNTED(Wait, MPI_COMM_NULL, (MPI_Request * r, MPI_Status* s), (r, s))
COUNTED(Waitall, MPI_COMM_NULL, (int n, MPI_Request* r, MPI_Status* s), (n, r, s))
COUNTED(Waitany, MPI_COMM_NULL, (int n, MPI_Request* r, int* k, MPI_Status* s), (n, r, k, s))
COUNTED(Test, MPI_COMM_NULL, (MPI_Request * r, int* done, MPI_Status* s), (r, done, s))
COUNTED(Testall, MPI_COMM_NULL, (int n, MPI_Request* r, int* done, MPI_Status* s), (n, r, done, s))
COUNTED(Barrier, c, (MPI_Comm c), (c))
COUNTED(Ibarrier, c, (MPI_Comm c, MPI_Request* r), (c, r))
COUNTED(Bcast, c, (void* x, int n, MPI_Datatype t, int root, MPI_Comm c), (x, n, t, root, c))
COUNTED(Reduce, c, (const void* x, void* y, int n, MPI_Datatype t, MPI_Op o, int root, MPI_Comm c),
                   (x, y, n, t, o, root, c))
COUNTED(Allreduce, c, (const void* x, void* y, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c),
                   (x, y, n, t, o, c))
COUNTED(Iallreduce, c,
                   (const void* x, void* y, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c, MPI_Request* r),
                   (x, y, n, t, o, c, r))
COUNTED(Exscan, c, (const void* x, void* y, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c), (x, y, n, t, o, c))
COUNTED(Scan, c, (const void* x, void* y, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c), (x, y, n, t, o, c))
COUNTED(Allgather, c, (const void* x, int n, MPI_Datatype t, void* y, int m, MPI_Datatype u, MPI_Comm c),
                   (x, n, t, y, m, u, c))
COUNTED(Allgatherv, c,
                   (const void* x, int n, MPI_Datatype t, void* y, const int* m, const int* at, MPI_Datatype u,
                    MPI_Comm c),
                   (x, n, t, y, m, at, u, c))
COUNTED(Alltoall, c, (const void* x, int n, MPI_Datatype t, void* y, int m, MPI_Datatype u, MPI_Comm c),
                   (x, n, t, y, m, u, c))
COUNTED(Alltoallv, c,
                   (const void* x, const int* n, const int* at, MPI_Datatype t, void* y, const int* m, const int* to,
                    MPI_Datatype u, MPI_Comm c),
                   (x, n, at, t, y, m, to, u, c))
int MPI_Comm_dup(MPI_Comm of, MPI_Comm* fresh) {
    counted::call("Comm_dup");
    return PMPI_Comm_dup(of, fresh);
}
int MPI_Comm_free(MPI_Comm* c) {
    counted::call("Comm_free", *c);
    return PMPI_Comm_free(c);
}

}  // extern "C"

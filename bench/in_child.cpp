#include "in_child.hpp"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>

namespace {

int without_exceptions(const std::function<int()>& work) {
    try {
        return work();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}

[[noreturn]] void fail(const char* call) {
    std::perror(call);
    std::exit(2);
}

}  // namespace

void* shared_bytes(std::size_t size) {
    void* memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) fail("mmap");
    return memory;
}

std::string in_child(unsigned most_seconds, const std::function<int()>& work) {
    std::fflush(nullptr);  // or the child would print what the parent has not yet
    const pid_t child = fork();
    if (child < 0) fail("fork");
    if (child == 0) {
        const rlimit no_core{0, 0};
        setrlimit(RLIMIT_CORE, &no_core);
        alarm(most_seconds);
        const int code = without_exceptions(work);
        std::fflush(nullptr);
        _exit(code);
    }
    int status = 0;
    if (waitpid(child, &status, 0) != child) fail("waitpid");
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
        return "more than " + std::to_string(most_seconds) + " s";
    }
    if (WIFSIGNALED(status)) return "signal " + std::to_string(WTERMSIG(status));
    if (WEXITSTATUS(status) != 0) return "ended with " + std::to_string(WEXITSTATUS(status));
    return "";
}

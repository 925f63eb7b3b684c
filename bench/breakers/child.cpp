#include "child.hpp"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <new>

namespace {

// A runaway must not take the machine with it.
constexpr rlim_t most_address_space = rlim_t{8} << 30;

[[noreturn]] void fail(const char* call) {
    std::perror(call);
    std::exit(2);
}

Outcome* shared_outcomes(std::size_t count) {
    const std::size_t size = (count + 1) * sizeof(Outcome);
    void* memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) fail("mmap");
    return static_cast<Outcome*>(memory);
}

pid_t start(const Trial& trial, Outcome& outcome) {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child < 0) fail("fork");
    if (child == 0) {
        const rlimit space{most_address_space, most_address_space};
        setrlimit(RLIMIT_AS, &space);
        const rlimit no_core{0, 0};
        setrlimit(RLIMIT_CORE, &no_core);
        alarm(trial.wall_limit);
        run_trial(trial, outcome);
        _exit(0);
    }
    return child;
}

}  // namespace

std::vector<Outcome> run_in_children(const std::vector<Trial>& trials, unsigned jobs,
                                     const std::function<void(std::size_t, const Outcome&)>& finished) {
    Outcome* outcomes = shared_outcomes(trials.size());
    std::map<pid_t, std::size_t> running;
    std::size_t next = 0;
    while (next < trials.size() || !running.empty()) {
        if (next < trials.size() && running.size() < jobs) {
            running[start(trials[next], outcomes[next])] = next;
            ++next;
            continue;
        }
        int status = 0;
        const pid_t child = wait(&status);
        if (child < 0) fail("wait");
        const std::size_t index = running.at(child);
        running.erase(child);
        outcomes[index].signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
        outcomes[index].exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
        finished(index, outcomes[index]);
    }
    std::vector<Outcome> result(outcomes, outcomes + trials.size());
    munmap(outcomes, (trials.size() + 1) * sizeof(Outcome));
    return result;
}

#include "workbench/worker/sandbox.h"

#include <cerrno>
#include <cstddef>
#include <cstdint>

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

// --- files: Landlock, which the C library does not wrap

/// Version of Landlock's interface; below 1: there is none.
long landlock_version() {
    return syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
}

/// Every access that this version can refuse: a kernel refuses bits that it does not know. The
/// header may be older than the kernel, so that later bits have no name in it.
std::uint64_t known_accesses(long version) {
    constexpr std::uint64_t kFirst = (1ULL << 13U) - 1, kRefer = 1ULL << 13U,
                            kTruncate = 1ULL << 14U, kDeviceControl = 1ULL << 15U;
    return kFirst | (version >= 2 ? kRefer : 0) | (version >= 3 ? kTruncate : 0) |
           (version >= 5 ? kDeviceControl : 0);
}

/// Lets a file, or a folder with all in it, be read.
void allow_reading(int ruleset, const fs::path& path) {
    // Stays open for as long as the process: some file systems (proc, 9p) forget an inode that
    // nobody holds, and with it the rule.
    const int place = open(path.c_str(), O_PATH | O_CLOEXEC);

    struct stat info {};

    if (place < 0 || fstat(place, &info) != 0) return;
    const bool folder = S_ISDIR(info.st_mode);
    landlock_path_beneath_attr rule{};
    rule.allowed_access = LANDLOCK_ACCESS_FS_READ_FILE;
    if (folder) rule.allowed_access |= LANDLOCK_ACCESS_FS_READ_DIR;
    rule.parent_fd = place;
    syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
}

// oneTBB loads its allocator and asks for stacks and pages when it is first used, the C library for
// processors, the worker for its own memory. None of it is a user's.
constexpr const char* kSystem[] = {"/lib",           "/lib64",           "/usr/lib",
                                   "/usr/lib64",     "/etc/ld.so.cache", "/sys/devices/system",
                                   "/sys/kernel/mm", "/proc/meminfo",    "/proc/stat",
                                   "/proc/sys/vm",   "/proc/self/maps",  "/proc/self/status",
                                   "/dev/null",      "/dev/urandom"};

bool restrict_files(const std::vector<fs::path>& readable) {
    const long version = landlock_version();
    if (version < 1) return false;
    landlock_ruleset_attr handled{};
    handled.handled_access_fs = known_accesses(version);
    const auto ruleset =
        static_cast<int>(syscall(SYS_landlock_create_ruleset, &handled, sizeof handled, 0));
    if (ruleset < 0) return false;
    for (const char* place : kSystem) allow_reading(ruleset, place);
    for (const fs::path& place : readable) allow_reading(ruleset, place);
    const bool restricted = syscall(SYS_landlock_restrict_self, ruleset, 0) == 0;
    close(ruleset);
    return restricted;
}

// --- calls: a seccomp filter that names what is refused. A list of what is allowed would be
// tighter, and would break with each version of the C library or of a library that uses another
// call for the same work.

constexpr std::uint32_t kRefuse = SECCOMP_RET_ERRNO | EPERM;
constexpr std::uint32_t kUnknown = SECCOMP_RET_ERRNO | ENOSYS;

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kArchitecture = 0;  // not known here: no filter
#endif

// Linux 6.1's calls end here, on all architectures. Later ones could do what the list refuses:
// every library does without them on that kernel.
constexpr std::uint32_t kFirstLaterCall = 451;

constexpr std::uint32_t kRefusedCalls[] = {
    // network
    SYS_socket, SYS_socketpair, SYS_connect, SYS_bind, SYS_listen, SYS_accept, SYS_accept4,
    SYS_sendto, SYS_sendmsg, SYS_sendmmsg,
    // programs
    SYS_execve, SYS_execveat,
#if defined(__x86_64__)
    SYS_fork, SYS_vfork,
#endif
    // other processes
    SYS_ptrace, SYS_process_vm_readv, SYS_process_vm_writev, SYS_process_madvise, SYS_kcmp,
    SYS_pidfd_open, SYS_pidfd_getfd, SYS_pidfd_send_signal, SYS_tkill, SYS_rt_sigqueueinfo,
    SYS_rt_tgsigqueueinfo, SYS_shmget, SYS_shmat, SYS_msgget, SYS_semget, SYS_mq_open,
    // what Landlock leaves to the permissions of a file
    SYS_fchmod, SYS_fchmodat, SYS_fchown, SYS_fchownat, SYS_setxattr, SYS_lsetxattr, SYS_fsetxattr,
    SYS_removexattr, SYS_lremovexattr, SYS_fremovexattr, SYS_utimensat, SYS_open_by_handle_at,
#if defined(__x86_64__)
    SYS_chmod, SYS_chown, SYS_lchown, SYS_utime, SYS_utimes, SYS_futimesat,
#endif
    // ways around this filter, and parts of the kernel that no reader needs
    SYS_io_uring_setup, SYS_io_uring_enter, SYS_io_uring_register, SYS_bpf, SYS_perf_event_open,
    SYS_userfaultfd, SYS_add_key, SYS_request_key, SYS_keyctl,
    // the system, for a worker of root
    SYS_mount, SYS_umount2, SYS_pivot_root, SYS_chroot, SYS_setns, SYS_unshare, SYS_open_tree,
    SYS_move_mount, SYS_fsopen, SYS_fsconfig, SYS_fsmount, SYS_fspick, SYS_mount_setattr,
    SYS_init_module, SYS_finit_module, SYS_delete_module, SYS_kexec_load, SYS_reboot, SYS_swapon,
    SYS_swapoff, SYS_acct, SYS_quotactl, SYS_sethostname, SYS_setdomainname, SYS_settimeofday,
    SYS_clock_settime, SYS_clock_adjtime, SYS_adjtimex};

sock_filter load(std::size_t offset) {
    return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
}

sock_filter end(std::uint32_t action) {
    return BPF_STMT(BPF_RET | BPF_K, action);
}

/// Skips `met` instructions if the loaded value meets the test, else `unmet`.
sock_filter test(std::uint16_t how, std::uint32_t value, std::uint8_t met, std::uint8_t unmet) {
    return BPF_JUMP(static_cast<std::uint16_t>(BPF_JMP | how | BPF_K), value, met, unmet);
}

constexpr std::size_t kCall = offsetof(seccomp_data, nr);
constexpr std::size_t kFirstArgument = offsetof(seccomp_data, args);  // its lower half

/// Ends with "allowed" if the call's first argument meets the test, else with "refused".
void end_by_argument(std::vector<sock_filter>& code, std::uint16_t how, std::uint32_t value) {
    code.push_back(load(kFirstArgument));
    code.push_back(test(how, value, 0, 1));
    code.push_back(end(SECCOMP_RET_ALLOW));
    code.push_back(end(kRefuse));
}

std::vector<sock_filter> filter() {
    // Another architecture's numbers mean other calls.
    std::vector<sock_filter> code = {
        load(offsetof(seccomp_data, arch)),   test(BPF_JEQ, kArchitecture, 1, 0),
        end(SECCOMP_RET_KILL_PROCESS),        load(kCall),
        test(BPF_JGE, kFirstLaterCall, 0, 1), end(kUnknown)};
    for (const std::uint32_t call : kRefusedCalls) {
        code.push_back(test(BPF_JEQ, call, 0, 1));
        code.push_back(end(kRefuse));
    }
    // A filter cannot see the arguments of clone3: the C library then starts threads by clone.
    code.push_back(test(BPF_JEQ, SYS_clone3, 0, 1));
    code.push_back(end(kUnknown));
    code.push_back(test(BPF_JEQ, SYS_clone, 0, 4));
    end_by_argument(code, BPF_JSET, CLONE_THREAD);
    // abort() sends itself a signal.
    code.push_back(test(BPF_JEQ, SYS_kill, 1, 0));
    code.push_back(test(BPF_JEQ, SYS_tgkill, 0, 4));
    end_by_argument(code, BPF_JEQ, static_cast<std::uint32_t>(getpid()));
    code.push_back(end(SECCOMP_RET_ALLOW));
    return code;
}

bool filters_are_available() {
    std::uint32_t action = SECCOMP_RET_ERRNO;
    return kArchitecture != 0 && syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &action) == 0;
}

bool restrict_calls() {
    if (!filters_are_available()) return false;
    std::vector<sock_filter> code = filter();
    const sock_fprog program{static_cast<unsigned short>(code.size()), code.data()};
    return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

}  // namespace

Sandbox available_sandbox() {
    return {.files = landlock_version() >= 1, .calls = filters_are_available()};
}

Sandbox enter_sandbox(const std::vector<fs::path>& readable) {
    // Without it, only root may restrict itself: a program with more rights could be started.
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return {};
    const bool files = restrict_files(readable);
    return {.files = files, .calls = restrict_calls()};
}

}  // namespace vesselbench

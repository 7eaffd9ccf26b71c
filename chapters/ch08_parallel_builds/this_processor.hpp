/// @file
/// The machine at hand: cpuid asked on each processor that this process may use, one after the
/// other. Where there is no such instruction (another architecture, or SPACE_NO_CPUID defined to
/// try that), nothing is recorded.
#pragma once

#include "chapters/ch08_parallel_builds/topology.hpp"

#include <sched.h>
#include <unistd.h>

#include <cstdint>
#include <system_error>
#include <vector>

#if (defined(__x86_64__) || defined(__i386__)) && !defined(SPACE_NO_CPUID)
#define SPACE_HAS_CPUID 1
#endif

namespace space {

/// A set of processors, as the kernel takes it, with room for as many as it may know.
class ProcessorSet {
  public:
    /// Those on which the calling thread may run.
    static ProcessorSet allowed() {
        for (std::size_t room = 1024;; room *= 2) {  // EINVAL: the kernel knows more
            ProcessorSet set(room);
            if (sched_getaffinity(0, set.bytes(), set.words_.data()) == 0) return set;
            if (errno != EINVAL || room > (1u << 20))
                throw std::system_error(errno, std::generic_category(), "sched_getaffinity");
        }
    }
    static ProcessorSet only(unsigned number) {
        ProcessorSet set(number + 1);
        CPU_SET_S(number, set.bytes(), set.words_.data());
        return set;
    }
    /// Lets the calling thread run on these alone. @return whether the kernel does so
    bool apply() const { return sched_setaffinity(0, bytes(), words_.data()) == 0; }

    std::vector<unsigned> numbers() const {
        std::vector<unsigned> all;
        for (unsigned i = 0; i < 8 * bytes(); ++i)
            if (CPU_ISSET_S(i, bytes(), words_.data())) all.push_back(i);
        return all;
    }

  private:
    explicit ProcessorSet(std::size_t room) : words_(room / (8 * sizeof(cpu_set_t)) + 1) {
        CPU_ZERO_S(bytes(), words_.data());
    }
    std::size_t bytes() const { return words_.size() * sizeof(cpu_set_t); }

    std::vector<cpu_set_t> words_;
};

// [on_processor]
/// While it lives, the thread that made it runs on one processor; then it may run where it could
/// before.
class OnProcessor {
  public:
    explicit OnProcessor(unsigned number)
        : before_(ProcessorSet::allowed()), is_there_(ProcessorSet::only(number).apply()) {}
    ~OnProcessor() { before_.apply(); }
    OnProcessor(const OnProcessor&) = delete;
    OnProcessor& operator=(const OnProcessor&) = delete;

    /// Not where the processor has been switched off, or forbidden, meanwhile.
    bool is_there() const { return is_there_; }

  private:
    ProcessorSet before_;
    bool is_there_;
};
// [on_processor]

/// The processors that this process may use. A container, taskset or a batch system may have left
/// it few.
inline std::vector<unsigned> allowed_processors() {
    return ProcessorSet::allowed().numbers();
}

/// How many are switched on, for whatever process.
inline std::size_t online_processors() {
    const long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count > 0 ? std::size_t(count) : 1;
}

#ifdef SPACE_HAS_CPUID

// [has_cpuid]
/// Bit 21 of the flags can be changed where there is cpuid, as there is on every processor of 64
/// bits.
inline bool has_cpuid() {
#ifdef __x86_64__
    const auto read = [] { return __builtin_ia32_readeflags_u64(); };
    const auto write = [](unsigned long long flags) { __builtin_ia32_writeeflags_u64(flags); };
#else
    const auto read = [] { return __builtin_ia32_readeflags_u32(); };
    const auto write = [](unsigned flags) { __builtin_ia32_writeeflags_u32(flags); };
#endif
    const auto before = read();
    write(before ^ (1u << 21));
    const bool has_changed = ((before ^ read()) >> 21) & 1u;
    write(before);
    return has_changed;
}
// [has_cpuid]

// [ask]
inline CpuidRegisters ask_cpuid(std::uint32_t leaf, std::uint32_t subleaf) {
    CpuidRegisters r;
    asm volatile("cpuid"
                 : "=a"(r.eax), "=b"(r.ebx), "=c"(r.ecx), "=d"(r.edx)
                 : "a"(leaf), "c"(subleaf));
    return r;
}

/// Allowed only where cpuid says OSXSAVE.
inline std::uint64_t ask_xcr0() {
    std::uint32_t low = 0, high = 0;
    asm volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return (std::uint64_t{high} << 32) | low;
}
// [ask]

/// All that this chapter reads, from the processor on which the calling thread runs.
inline CpuidLeaves record_leaves() {
    CpuidLeaves record;
    const auto ask = [&](std::uint32_t leaf, std::uint32_t subleaves = 1) {
        if (leaf != (leaf & 0x80000000u) && !record.has(leaf)) return;
        for (std::uint32_t i = 0; i < subleaves; ++i)
            record.leaves.push_back({leaf, i, ask_cpuid(leaf, i)});
    };
    for (const std::uint32_t leaf : {0x0u, 0x1u, 0x4u, 0x7u, 0x1au}) ask(leaf);
    for (const std::uint32_t leaf : {0xbu, 0x1fu}) ask(leaf, 8);
    for (const std::uint32_t leaf : {0x0u, 0x1u, 0x2u, 0x3u, 0x4u, 0x8u, 0x1eu})
        ask(0x80000000u + leaf);
    if (bits_of(record.at(1).ecx, 27, 27)) record.xcr0 = ask_xcr0();
    return record;
}

// [record]
/// cpuid tells of the processor that executes it, so it is asked on each in turn.
inline std::vector<RecordedProcessor> record_this_machine() {
    std::vector<RecordedProcessor> recorded;
    if (!has_cpuid()) return recorded;
    for (const unsigned number : allowed_processors())
        if (const OnProcessor here(number); here.is_there())
            recorded.push_back({number, record_leaves()});
    return recorded;
}
// [record]

#else

inline std::vector<RecordedProcessor> record_this_machine() {
    return {};
}

#endif

}  // namespace space

// SPDX-License-Identifier: MIT
//
// Tasks on two threads: the caller's, and one that spins until there is work.

#ifndef TALUS_BENCH_SECOND_THREAD_HPP
#define TALUS_BENCH_SECOND_THREAD_HPP

#include <atomic>
#include <talus/base.h>
#include <thread>

class second_thread
{
  public:
    ~second_thread()
    {
        give(nullptr, 0, nullptr);
        thread.join();
    }

    tl_tasks tasks()
    {
        return { run, 2, this };
    }

  private:
    // The thread looks again and again, as those of job systems do for a while: to be woken takes tens of microseconds.
    void give(tl_task_fn *new_task, uint32_t new_count, void *user)
    {
        task = new_task;
        count = new_count;
        task_user = user;
        next = 0;
        working = true;
        round.fetch_add(1, std::memory_order_release);
    }

    void work(uint32_t worker)
    {
        for (uint32_t i; (i = next.fetch_add(1)) < count;) {
            task(i, worker, task_user);
        }
    }

    void serve()
    {
        for (uint64_t seen = 0;; seen++) {
            while (round.load(std::memory_order_acquire) == seen) {
                std::this_thread::yield();
            }
            if (task == nullptr) {
                return;
            }
            work(1);
            working.store(false, std::memory_order_release);
        }
    }

    static void run(tl_task_fn *task, uint32_t count, void *task_user, void *user)
    {
        second_thread *self = static_cast<second_thread *>(user);
        self->give(task, count, task_user);
        self->work(0);
        while (self->working.load(std::memory_order_acquire)) {
            std::this_thread::yield();
        }
    }

    tl_task_fn *task = nullptr;
    void *task_user = nullptr;
    uint32_t count = 0;
    std::atomic<uint32_t> next{ 0 };
    std::atomic<uint64_t> round{ 0 };
    std::atomic<bool> working{ false };
    std::thread thread{ [this] { serve(); } };
};

#endif

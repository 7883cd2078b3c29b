// SPDX-License-Identifier: MIT
//
// Tasks on two threads: the caller's, and one that waits for work.

#ifndef TALUS_BENCH_SECOND_THREAD_HPP
#define TALUS_BENCH_SECOND_THREAD_HPP

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <talus/base.h>
#include <thread>

// A thread that waits for work beside the caller's.
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
    void give(tl_task_fn *new_task, uint32_t new_count, void *user)
    {
        std::lock_guard<std::mutex> lock(mutex);
        task = new_task;
        count = new_count;
        task_user = user;
        next = 0;
        round++;
        working = true;
        wake.notify_one();
    }

    void work(uint32_t worker)
    {
        for (uint32_t i; (i = next.fetch_add(1)) < count;) {
            task(i, worker, task_user);
        }
    }

    void serve()
    {
        for (uint64_t seen = 0;;) {
            std::unique_lock<std::mutex> lock(mutex);
            wake.wait(lock, [&] { return round != seen; });
            seen = round;
            if (task == nullptr) {
                return;
            }
            lock.unlock();
            work(1);
            lock.lock();
            working = false;
            done.notify_one();
        }
    }

    static void run(tl_task_fn *task, uint32_t count, void *task_user, void *user)
    {
        second_thread *self = static_cast<second_thread *>(user);
        self->give(task, count, task_user);
        self->work(0);
        std::unique_lock<std::mutex> lock(self->mutex);
        self->done.wait(lock, [&] { return !self->working; });
    }

    std::mutex mutex;
    std::condition_variable wake, done;
    tl_task_fn *task = nullptr;
    void *task_user = nullptr;
    uint32_t count = 0;
    std::atomic<uint32_t> next{ 0 };
    uint64_t round = 0;
    bool working = false;
    std::thread thread{ [this] { serve(); } };
};

#endif

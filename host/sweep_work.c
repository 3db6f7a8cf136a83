#include "sweep_work.h"

#include "progress.h"
#include "sweep_measure.h"

#include <pthread.h>
#include <signal.h>
#include <string.h>

enum { MOST_WORKERS = 64 };

/* ---- signals --------------------------------------------------------------------------------------------------- */

static volatile sig_atomic_t caught;

static void catch_signal(int number)
{
    caught = number;
}

void sweep_catch_signals(void)
{
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    struct sigaction action, old;
    memset(&action, 0, sizeof action);
    action.sa_handler = catch_signal;
    action.sa_flags = SA_RESETHAND;
    sigemptyset(&action.sa_mask);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (sigaction(numbers[i], 0, &old) == 0 && old.sa_handler != SIG_IGN) /* as nohup has it */
            sigaction(numbers[i], &action, 0);
}

int sweep_interrupted(void)
{
    return caught;
}

/* ---- how much work a row is ------------------------------------------------------------------------------------ */

/* Triangles set up, texels, pixels: about as long each. */
static double work_of(const sweep_cell *cell)
{
    double map = cell->map ? cell->map : 1024;
    double frame = (double)packed_triangle_count(&cell->scene->packed) + map * map / 8 +
                   (double)cell->scene->width * cell->scene->height / 4;
    return cell->chain->searches_bias ? 3 * frame : frame;
}

static int is_to_do(const sweep_plan *plan, size_t i)
{
    return !plan->cells[i].is_done && !plan->cells[i].reason && plan->cells[i].twin == i;
}

/* ---- the queue ------------------------------------------------------------------------------------------------- */

typedef struct queue {
    sweep_plan *plan;
    sweep_journal *journal;
    size_t next;
    unsigned rows_done, rows;
    double work_done, work;
    progress shown;
    int failed;
    problem *why;
    pthread_mutex_t lock;
} queue;

static size_t take_next(queue *q)
{
    while (q->next < q->plan->count && !is_to_do(q->plan, q->next))
        q->next++;
    return q->failed || sweep_interrupted() ? q->plan->count : q->next++;
}

/* After sweep_measure; under the lock. */
static void put_down(queue *q, size_t index, int refused, const problem *reason)
{
    sweep_plan *plan = q->plan;
    if (refused) {
        for (size_t i = index; i < plan->count; i++)
            if (plan->cells[i].twin == index)
                sweep_cell_leave_out(&plan->cells[i], reason->text);
    } else if (sweep_journal_append(q->journal, plan, index, q->why)) {
        q->failed = 1;
    }
    q->rows_done++;
    q->work_done += work_of(&plan->cells[index]);
    progress_show_left(&q->shown, q->rows_done, q->rows, q->work_done / q->work);
}

static void *work(void *user)
{
    queue *q = user;
    problem reason;
    for (;;) {
        pthread_mutex_lock(&q->lock);
        size_t index = take_next(q);
        pthread_mutex_unlock(&q->lock);
        if (index >= q->plan->count)
            return 0;
        int refused = sweep_measure(&q->plan->cells[index], q->plan->image_text, &reason);
        pthread_mutex_lock(&q->lock);
        put_down(q, index, refused, &reason);
        pthread_mutex_unlock(&q->lock);
    }
}

static void count_work(queue *q)
{
    for (size_t i = 0; i < q->plan->count; i++)
        if (is_to_do(q->plan, i)) {
            q->rows++;
            q->work += work_of(&q->plan->cells[i]);
        }
}

int sweep_work(sweep_plan *plan, sweep_journal *journal, int workers, problem *why)
{
    queue q = {.plan = plan, .journal = journal, .shown = progress_start("sweep"), .why = why};
    pthread_t threads[MOST_WORKERS];
    int started = 1;
    count_work(&q);
    pthread_mutex_init(&q.lock, 0);
    for (; started < workers; started++)
        if (pthread_create(&threads[started], 0, work, &q) != 0)
            break; /* done without */
    work(&q);
    for (int i = 1; i < started; i++)
        pthread_join(threads[i], 0);
    pthread_mutex_destroy(&q.lock);
    progress_end(&q.shown);
    return q.failed ? -1 : 0;
}

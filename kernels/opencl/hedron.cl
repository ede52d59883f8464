/* SPDX-License-Identifier: MIT */
/* The kernels in OpenCL C. */
#include "dialect.h"

/* The hint says that items are packets already: without it Intel's compiler takes several times as
   long to find that it cannot vectorise over items. */
#if HD_GROUP_SIZE
#define KERNEL __kernel void
#else
#define KERNEL __kernel __attribute__((vec_type_hint(vreal))) void
#endif
#define SHARED  __local
#define WORKER  ((int)get_global_id(0))
#define WORKERS ((int)get_global_size(0))
#define GROUP   ((int)get_group_id(0))
#define GROUPS  ((int)get_num_groups(0))
#define THREAD  ((int)get_local_id(0))
#define THREADS ((int)get_local_size(0))
#define SMALL_TABLES(X)

#include "../common/entries.h"

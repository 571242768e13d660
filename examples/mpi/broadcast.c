/* Rank 0 fits a surface and broadcasts its bytes; every rank evaluates its own nodes, and rank 0 gathers them. */
#include <mpi.h>
#include <planish.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 61, NODES = SIDE * SIDE, DIM = 3 };

/* The library's status: an error ends all ranks. */
static void must(planish_status status) {
  char text[256];
  if (status >= 0) return;
  planish_error_message(text, sizeof text);
  fprintf(stderr, "%s\n", text);
  MPI_Abort(MPI_COMM_WORLD, 1);
}

/* Memory, or the end of all ranks. */
static void *room(size_t size) {
  void *memory = malloc(size ? size : 1);
  if (!memory) MPI_Abort(MPI_COMM_WORLD, 1);
  return memory;
}

/* The first of `count` things that `rank` has; no rank has more than one more than another. */
static int first_of(int rank, int ranks, int count) {
  const int share = count / ranks, rest = count % ranks;
  return rank * share + (rank < rest ? rank : rest);
}

/* The nodes that all ranks know: their (u,v), and on rank 0 their places in space. */
static void make_nodes(double uv[][2], double points[][DIM]) {
  int i;
  for (i = 0; i < NODES; ++i) {
    const double u = i / SIDE / (SIDE - 1.0), v = i % SIDE / (SIDE - 1.0);
    uv[i][0] = u, uv[i][1] = v;
    points[i][0] = u, points[i][1] = v, points[i][2] = 0.1 * sin(6 * u) * cos(5 * v);
  }
}

int main(int argc, char **argv) {
  static double uv[NODES][2], points[NODES][DIM], all[NODES][DIM], serial[NODES][DIM];
  planish_surface *surface = NULL;
  planish_eval_options options;
  double *own;
  uint8_t *bytes;
  uint64_t size = 0;
  int rank, ranks, first, count, i, equal = 1, *counts, *starts;

  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  make_nodes(uv, points);

  if (rank == 0) {
    must(planish_tensor_fit_points(uv[0], points[0], NODES, DIM, NULL, &surface, NULL));
    size = planish_surface_save_size(surface);
  }
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  bytes = room(size);
  if (rank == 0) must(planish_surface_save(surface, bytes, size));
  MPI_Bcast(bytes, (int)size, MPI_BYTE, 0, MPI_COMM_WORLD);
  if (rank != 0) must(planish_surface_load(bytes, size, &surface));

  must(planish_eval_options_init(&options, sizeof options));
  options.thread_count = 1; /* the ranks share the cores */
  first = first_of(rank, ranks, NODES);
  count = first_of(rank + 1, ranks, NODES) - first;
  own = room(sizeof(double) * DIM * (size_t)count);
  must(planish_surface_eval(surface, uv[first], (size_t)count, &options, own));

  counts = room(sizeof *counts * (size_t)ranks);
  starts = room(sizeof *starts * (size_t)ranks);
  for (i = 0; i < ranks; ++i) {
    starts[i] = DIM * first_of(i, ranks, NODES);
    counts[i] = DIM * first_of(i + 1, ranks, NODES) - starts[i];
  }
  MPI_Gatherv(own, DIM * count, MPI_DOUBLE, all, counts, starts, MPI_DOUBLE, 0, MPI_COMM_WORLD);

  if (rank == 0) {
    must(planish_surface_eval(surface, uv[0], NODES, NULL, serial[0]));
    equal = memcmp(all, serial, sizeof all) == 0;
    printf("%d ranks, %d nodes, %lu bytes broadcast, %s the serial run\n", ranks, NODES, (unsigned long)size,
           equal ? "equal to" : "not equal to");
  }
  MPI_Bcast(&equal, 1, MPI_INT, 0, MPI_COMM_WORLD);
  planish_surface_free(surface);
  free(bytes), free(own), free(counts), free(starts);
  MPI_Finalize();
  return !equal;
}
/* Output: 3 ranks, 3721 nodes, 3272 bytes broadcast, equal to the serial run */

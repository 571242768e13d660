/* Fits faces of unlike size on all ranks: the largest first, each rank fetches its next one. What is done lies in a folder, so that
 * a run that was killed goes on where it was. The result is gathered in order and equals a serial run to the byte. */
#include <mpi.h>
#include <planish.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FACES = 60, LEAST_SIDE = 10, MOST_SIDE = 70, PATH = 512 };

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

/* Nodes along a side of a face: the work grows with their square. */
static int side_of(int face) { return LEAST_SIDE + face * 37 % (MOST_SIDE - LEAST_SIDE); }

/* The order of the work: by estimated work, the largest first, so that no rank begins a long face at the end. */
static int by_work(const void *a, const void *b) {
  const int one = *(const int *)a, other = *(const int *)b, gain = side_of(other) - side_of(one);
  return gain ? gain : one - other;
}

/* Fits one face of the model. */
static planish_surface *fit_face(int face) {
  const int side = side_of(face);
  double(*uv)[2] = room(sizeof *uv * (size_t)side * (size_t)side);
  double(*points)[3] = room(sizeof *points * (size_t)side * (size_t)side);
  planish_surface *surface = NULL;
  planish_tensor_options options;
  int i;
  for (i = 0; i < side * side; ++i) {
    const double x = i / side / (side - 1.0), y = i % side / (side - 1.0);
    uv[i][0] = x, uv[i][1] = y;
    points[i][0] = x + face, points[i][1] = y, points[i][2] = 0.1 * sin((3 + face % 7) * x) * cos((2 + face % 5) * y);
  }
  must(planish_tensor_options_init(&options, sizeof options));
  options.thread_count = 1; /* the ranks share the cores */
  must(planish_tensor_fit_points(uv[0], points[0], (size_t)side * (size_t)side, 3, &options, &surface, NULL));
  free(uv), free(points);
  return surface;
}

static void path_of(const char *folder, int face, char path[PATH]) { snprintf(path, PATH, "%s/face-%05d.planish", folder, face); }

/* A face of an earlier run: files are written whole or not at all, so one that loads is one that was done. */
static planish_surface *done_before(const char *folder, int face) {
  planish_surface *surface = NULL;
  char path[PATH];
  if (!folder) return NULL;
  path_of(folder, face, path);
  return planish_surface_load_file(path, &surface) == PLANISH_STATUS_OK ? surface : NULL;
}

/* The saved bytes of a surface, which is freed. */
static void *bytes_of(planish_surface *surface, int *size) {
  void *bytes;
  *size = (int)planish_surface_save_size(surface);
  bytes = room((size_t)*size);
  must(planish_surface_save(surface, bytes, (size_t)*size));
  planish_surface_free(surface);
  return bytes;
}

/* The next number of a counter that rank 0 keeps. */
static int fetch_next(MPI_Win counter) {
  const int one = 1;
  int next;
  MPI_Win_lock(MPI_LOCK_SHARED, 0, 0, counter);
  MPI_Fetch_and_op(&one, &next, MPI_INT, 0, 0, MPI_SUM, counter);
  MPI_Win_unlock(0, counter);
  return next;
}

int main(int argc, char **argv) {
  int rank, ranks, faces, limit, taken = 0, resumed = 0, all_taken = 0, all_resumed = 0, equal = 1, i;
  int *order, *sizes, *counter_memory;
  void **saved;
  const char *folder;
  double begin, seconds, serial_seconds;
  MPI_Win counter;

  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  faces = argc > 1 ? atoi(argv[1]) : FACES;
  folder = argc > 2 ? argv[2] : NULL;
  limit = argc > 3 ? atoi(argv[3]) : faces; /* how many faces a rank fits before it dies: to try the checkpoint */

  order = room(sizeof *order * (size_t)faces);
  sizes = room(sizeof *sizes * (size_t)faces);
  saved = room(sizeof *saved * (size_t)faces);
  for (i = 0; i < faces; ++i) order[i] = i, sizes[i] = 0, saved[i] = NULL;
  qsort(order, (size_t)faces, sizeof *order, by_work);

  MPI_Win_allocate(rank == 0 ? (MPI_Aint)sizeof(int) : 0, sizeof(int), MPI_INFO_NULL, MPI_COMM_WORLD, &counter_memory, &counter);
  if (rank == 0) {
    MPI_Win_lock(MPI_LOCK_EXCLUSIVE, 0, 0, counter);
    *counter_memory = 0;
    MPI_Win_unlock(0, counter);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  begin = MPI_Wtime();
  for (i = fetch_next(counter); i < faces; i = fetch_next(counter)) {
    const int face = order[i];
    planish_surface *surface = done_before(folder, face);
    if (surface) {
      ++resumed;
    } else {
      char path[PATH];
      if (taken == limit) MPI_Abort(MPI_COMM_WORLD, 3);
      surface = fit_face(face);
      ++taken;
      if (folder) {
        path_of(folder, face, path);
        must(planish_surface_save_file(surface, path));
      }
    }
    saved[face] = bytes_of(surface, &sizes[face]);
  }

  /* in order: rank 0 asks for each face's bytes, whoever has them */
  {
    int *all_sizes = room(sizeof *all_sizes * (size_t)faces), *owner = room(sizeof *owner * (size_t)faces);
    for (i = 0; i < faces; ++i) owner[i] = saved[i] ? rank : -1;
    MPI_Allreduce(MPI_IN_PLACE, owner, faces, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    MPI_Allreduce(sizes, all_sizes, faces, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    for (i = 0; i < faces; ++i) {
      if (owner[i] == 0) continue;
      if (rank == 0) {
        saved[i] = room((size_t)all_sizes[i]);
        MPI_Recv(saved[i], all_sizes[i], MPI_BYTE, owner[i], i, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
      } else if (rank == owner[i]) {
        MPI_Send(saved[i], sizes[i], MPI_BYTE, 0, i, MPI_COMM_WORLD);
      }
    }
    memcpy(sizes, all_sizes, sizeof *sizes * (size_t)faces);
    free(all_sizes), free(owner);
  }
  seconds = MPI_Wtime() - begin;
  MPI_Reduce(&taken, &all_taken, 1, MPI_INT, MPI_SUM, 0, MPI_COMM_WORLD);
  MPI_Reduce(&resumed, &all_resumed, 1, MPI_INT, MPI_SUM, 0, MPI_COMM_WORLD);

  if (rank == 0) {
    begin = MPI_Wtime();
    for (i = 0; i < faces; ++i) {
      int size;
      void *bytes = bytes_of(fit_face(i), &size);
      if (size != sizes[i] || memcmp(bytes, saved[i], (size_t)size) != 0) equal = 0;
      free(bytes);
    }
    serial_seconds = MPI_Wtime() - begin;
    printf("%d ranks, %d faces, %d from before, %s the serial run, %.3f s, serial %.3f s\n", ranks, all_taken + all_resumed,
           all_resumed, equal ? "equal to" : "not equal to", seconds, serial_seconds);
  }
  MPI_Bcast(&equal, 1, MPI_INT, 0, MPI_COMM_WORLD);
  for (i = 0; i < faces; ++i) free(saved[i]);
  free(order), free(sizes), free(saved);
  MPI_Win_free(&counter);
  MPI_Finalize();
  return !equal;
}
/* Output: 3 ranks, 60 faces, 0 from before, equal to the serial run, 0.412 s, serial 0.987 s */

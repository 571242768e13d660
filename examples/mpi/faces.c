/* Fits a batch of faces, each rank its share of them, and gathers the results in the order of the faces. */
#include <mpi.h>
#include <planish.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
  FACES = 200,         /* unless the command line says how many */
  SIDE = 25,           /* points along each side of a face */
  SAMPLES = 4,         /* places along each side at which the fitted face is evaluated */
  DIM = 3,
  ROW = 1 + SAMPLES * SAMPLES * DIM /* what a face comes to: its largest error, and its samples */
};

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

/* Fits one face, whose waves depend on its number, and evaluates it. */
static void fit_face(int face, double row[ROW]) {
  static double uv[SIDE * SIDE][2], points[SIDE * SIDE][DIM];
  double u[SAMPLES];
  planish_surface *surface = NULL;
  planish_tensor_options fit;
  planish_eval_options eval;
  planish_fit_report report;
  int i;
  for (i = 0; i < SIDE * SIDE; ++i) {
    const double x = i / SIDE / (SIDE - 1.0), y = i % SIDE / (SIDE - 1.0);
    uv[i][0] = x, uv[i][1] = y;
    points[i][0] = x, points[i][1] = y, points[i][2] = 0.1 * sin((3 + face % 7) * x) * cos((2 + face % 5) * y);
  }
  for (i = 0; i < SAMPLES; ++i) u[i] = i / (SAMPLES - 1.0);
  must(planish_tensor_options_init(&fit, sizeof fit));
  must(planish_eval_options_init(&eval, sizeof eval));
  fit.thread_count = eval.thread_count = 1; /* the ranks share the cores */
  report.struct_size = sizeof report;
  must(planish_tensor_fit_points(uv[0], points[0], SIDE * SIDE, DIM, &fit, &surface, &report));
  row[0] = report.max_error;
  must(planish_surface_eval_grid(surface, u, SAMPLES, u, SAMPLES, &eval, row + 1));
  planish_surface_free(surface);
}

static void fit_faces(int first, int count, double *rows) {
  int i;
  for (i = 0; i < count; ++i) fit_face(first + i, rows + (size_t)ROW * (size_t)i);
}

int main(int argc, char **argv) {
  double *own, *all, *serial, begin, parallel_seconds, serial_seconds;
  int rank, ranks, first, count, faces, most = 0, i, equal = 1, *counts, *starts;

  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  faces = argc > 1 ? atoi(argv[1]) : FACES;

  counts = room(sizeof *counts * (size_t)ranks);
  starts = room(sizeof *starts * (size_t)ranks);
  for (i = 0; i < ranks; ++i) {
    const int share = first_of(i + 1, ranks, faces) - first_of(i, ranks, faces);
    starts[i] = ROW * first_of(i, ranks, faces);
    counts[i] = ROW * share;
    if (share > most) most = share;
  }
  first = starts[rank] / ROW;
  count = counts[rank] / ROW;
  own = room(sizeof(double) * ROW * (size_t)count);
  all = room(sizeof(double) * ROW * (size_t)(rank == 0 ? faces : 0));

  MPI_Barrier(MPI_COMM_WORLD);
  begin = MPI_Wtime();
  fit_faces(first, count, own);
  MPI_Gatherv(own, counts[rank], MPI_DOUBLE, all, counts, starts, MPI_DOUBLE, 0, MPI_COMM_WORLD);
  parallel_seconds = MPI_Wtime() - begin;

  if (rank == 0) {
    serial = room(sizeof(double) * ROW * (size_t)faces);
    begin = MPI_Wtime();
    fit_faces(0, faces, serial);
    serial_seconds = MPI_Wtime() - begin;
    equal = memcmp(all, serial, sizeof(double) * ROW * (size_t)faces) == 0 && most == (faces + ranks - 1) / ranks;
    printf("%d ranks, %d faces, at most %d a rank, %s the serial run, %.3f s, serial %.3f s\n", ranks, faces, most,
           equal ? "equal to" : "not equal to", parallel_seconds, serial_seconds);
    free(serial);
  }
  MPI_Bcast(&equal, 1, MPI_INT, 0, MPI_COMM_WORLD);
  free(own), free(all), free(counts), free(starts);
  MPI_Finalize();
  return !equal;
}
/* Output: 3 ranks, 200 faces, at most 67 a rank, equal to the serial run, 0.318 s, serial 0.548 s */

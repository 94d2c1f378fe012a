/* The two foggy rooms of examples/embed, rendered in C99 with all decisions of the library. */
#ifndef ROOMS_H
#define ROOMS_H

#ifdef __cplusplus
extern "C" {
#endif

enum { rooms_width = 64, rooms_height = 36, rooms_pixels = rooms_width * rooms_height };

typedef struct rooms_picture {
    int first;   /* of the samples of all pictures */
    int samples; /* of each pixel */
    float mean[rooms_pixels][3];
    double squares[rooms_height]; /* of the mean channel of each sample, summed by row */
} rooms_picture;

/* The mean of a picture, and the variance of one sample. */
double rooms_mean(const rooms_picture* picture);
double rooms_variance(const rooms_picture* picture);

/* Renders classically, then learns in so many passes, each twice as long as the one before, and renders by what was
 * learned. Ends the program with a message if the library refuses anything. */
void rooms_render(int samples, int passes, rooms_picture* classical, rooms_picture* guided);

#ifdef __cplusplus
}
#endif

#endif

/* Two foggy rooms by C99: the same numbers as examples/embed, bit for bit. Exit status 0 if guiding leaves the mean and
 * lowers the variance. */
#include "rooms.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

int main(void) {
    const int samples = 64, passes = 5;
    rooms_picture* pictures = malloc(2 * sizeof *pictures);
    const rooms_picture *classical = pictures, *guided = pictures + 1;
    double gain, error, apart;
    if (!pictures) {
        return 1;
    }
    rooms_render(samples, passes, pictures, pictures + 1);
    printf("classical  mean %.4f, relative error of a sample %.2f\n", rooms_mean(classical),
           sqrt(rooms_variance(classical)) / rooms_mean(classical));
    printf("guided     mean %.4f, relative error of a sample %.2f\n", rooms_mean(guided),
           sqrt(rooms_variance(guided)) / rooms_mean(guided));
    gain = rooms_variance(classical) / rooms_variance(guided);
    error = sqrt((rooms_variance(classical) + rooms_variance(guided)) / ((double)samples * rooms_pixels));
    printf("%.1f times less variance by as many samples\n", gain);
    apart = fabs(rooms_mean(classical) - rooms_mean(guided));
    free(pictures);
    return apart < 4 * error && gain > 4 ? 0 : 1;
}

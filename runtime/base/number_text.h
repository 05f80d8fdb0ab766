/* Numbers as the shortest text that reads back as the same number. */
#ifndef TARTAN_BASE_NUMBER_TEXT_H
#define TARTAN_BASE_NUMBER_TEXT_H

#define TN_NUMBER_TEXT_SIZE 32u

/* Writes a finite number, and returns `text`. */
const char *tn_number_text(double number, char text[TN_NUMBER_TEXT_SIZE]);

#endif

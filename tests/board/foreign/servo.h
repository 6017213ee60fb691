/* The parts of the servo (servo.c). */
#ifndef FOREIGN_SERVO_H
#define FOREIGN_SERVO_H
void console_setup(void);
void text(const char* s);
void number(int v);
void line(char* into, int size);

void device_setup(void);
#endif

% Writes the MAT files of this folder with Octave: octave-cli make_mat.m
t = (0:199)' / 1000;
q = 0.125 * (0:199)';
single_current = single(q / 4);
counts = int32(0:199);                 % a row
both = [q, -q];
log = struct('volts', 2 * q, 'inner', struct('flag', q > 5));
gain = 35.15;
words = 'position in metres';
short = [1; 2; 3];
complex_one = q + 1i;
cells = {1, 2};
save('-v6', 'plain.mat', 't', 'q', 'single_current', 'counts', 'both', 'log', 'gain', 'words', 'short', 'complex_one', 'cells');
save('-v7', 'compressed.mat', 't', 'q', 'single_current', 'counts', 'both', 'log', 'gain', 'words', 'short', 'complex_one', 'cells');

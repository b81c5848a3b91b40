"""Ask the model beside a recording: joint coordinates from poses, and the next row from each row."""
